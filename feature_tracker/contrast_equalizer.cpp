// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/contrast_equalizer.h"

#include <algorithm>

namespace plm_vins {
namespace {

// To the nearest level, halves to even: adding 1.5 * 2^23 leaves no digits after the point. Unlike
// std::nearbyint(), compilers do that for many pixels at once.
uint8_t RoundToLevel(float value) {
  constexpr float kNoFraction = 12582912.0F;
  return static_cast<uint8_t>(static_cast<int>(value + kNoFraction - kNoFraction));
}

}  // namespace

ContrastEqualizer::ContrastEqualizer(const cv::Size& image_size)
    : image_size_(image_size), words_(image_size.width) {
  const cv::Size rest(image_size.width % kTiles, image_size.height % kTiles);
  // As cv::CLAHE has it: where one direction needs a margin, the other gets one, too.
  if (rest != cv::Size(0, 0)) margin_ = cv::Size(kTiles, kTiles) - rest;
  tile_size_ = (image_size + margin_) / kTiles;
  first_columns_.fill(image_size.width);
  for (int x = image_size.width - 1; x >= 0; --x) {
    first_columns_[Locate(x, tile_size_.width).cell] = x;
  }
  for (int x = 0; x < image_size.width; ++x) {
    shares_.push_back(Locate(x, tile_size_.width).share);
  }
}

ContrastEqualizer::Place ContrastEqualizer::Locate(int pixel, int tile_length) {
  const float tiles = 1.0F / static_cast<float>(tile_length);
  const float position = static_cast<float>(pixel) * tiles - 0.5F;
  const int tile_before = cvFloor(position);
  return {tile_before + 1, position - static_cast<float>(tile_before)};
}

cv::Mat ContrastEqualizer::Equalize(const cv::Mat& image) {
  const cv::Mat extended = Extend(image);
  for (int row = 0; row < kTiles; ++row) {
    for (int column = 0; column < kTiles; ++column) {
      const cv::Point corner(column * tile_size_.width, row * tile_size_.height);
      tables_[row][column] = MakeTable(extended(cv::Rect(corner, tile_size_)));
    }
  }
  cv::Mat equalized(image_size_, CV_8UC1);
  int joined_row = -1;
  for (int y = 0; y < image_size_.height; ++y) {
    const Place place = Locate(y, tile_size_.height);
    if (place.cell != joined_row) JoinTables(place.cell);
    joined_row = place.cell;
    LookUp(image.ptr(y));
    Interpolate(place.share, equalized.ptr(y));
  }
  return equalized;
}

cv::Mat ContrastEqualizer::Extend(const cv::Mat& image) const {
  if (margin_.empty()) return image;
  cv::Mat extended;
  cv::copyMakeBorder(image, extended, 0, margin_.height, 0, margin_.width, cv::BORDER_REFLECT_101);
  return extended;
}

// In four parts, by turns: neighbours are often equal, and their counts would wait for each other.
ContrastEqualizer::Histogram ContrastEqualizer::CountLevels(const cv::Mat& tile) {
  constexpr int kParts = 4;
  std::array<Histogram, kParts> parts{};
  for (int y = 0; y < tile.rows; ++y) {
    const uint8_t* row = tile.ptr(y);
    int x = 0;
    for (; x + kParts <= tile.cols; x += kParts) {
      for (int i = 0; i < kParts; ++i) ++parts[i][row[x + i]];
    }
    for (; x < tile.cols; ++x) ++parts[0][row[x]];
  }
  Histogram histogram{};
  for (int level = 0; level < kLevels; ++level) {
    for (const Histogram& part : parts) histogram[level] += part[level];
  }
  return histogram;
}

// Spreads what is above the limit over all levels: the same to each, the rest in even steps.
void ContrastEqualizer::Clip(Histogram* histogram) const {
  const int limit = std::max(static_cast<int>(kClipLimit * tile_size_.area() / kLevels), 1);
  int excess = 0;
  for (int& count : *histogram) {
    excess += std::max(count - limit, 0);
    count = std::min(count, limit);
  }
  for (int& count : *histogram) count += excess / kLevels;
  const int rest = excess % kLevels;
  const int step = rest > 0 ? kLevels / rest : 0;
  for (int i = 0; i < rest; ++i) ++(*histogram)[i * step];
}

ContrastEqualizer::Table ContrastEqualizer::MakeTable(const cv::Mat& tile) const {
  Histogram histogram = CountLevels(tile);
  Clip(&histogram);
  const float scale = static_cast<float>(kLevels - 1) / static_cast<float>(tile_size_.area());
  Table table;
  int sum = 0;
  for (int level = 0; level < kLevels; ++level) {
    sum += histogram[level];
    table[level] = RoundToLevel(static_cast<float>(sum) * scale);
  }
  return table;
}

// At the image's borders, one tile stands on both sides.
void ContrastEqualizer::JoinTables(int cell_row) {
  const auto& above = tables_[std::max(cell_row - 1, 0)];
  const auto& below = tables_[std::min(cell_row, kTiles - 1)];
  for (int cell = 0; cell < kCells; ++cell) {
    const int left = std::max(cell - 1, 0);
    const int right = std::min(cell, kTiles - 1);
    for (int level = 0; level < kLevels; ++level) {
      cell_tables_[cell][level] = static_cast<uint32_t>(above[left][level]) |
                                  static_cast<uint32_t>(above[right][level]) << 8U |
                                  static_cast<uint32_t>(below[left][level]) << 16U |
                                  static_cast<uint32_t>(below[right][level]) << 24U;
    }
  }
}

void ContrastEqualizer::LookUp(const uint8_t* row) {
  for (int cell = 0; cell < kCells; ++cell) {
    const CellTable& table = cell_tables_[cell];
    for (int x = first_columns_[cell]; x < first_columns_[cell + 1]; ++x) words_[x] = table[row[x]];
  }
}

void ContrastEqualizer::Interpolate(float share_below, uint8_t* equalized) const {
  // Pointers of its own, which no write of a byte can change: then pixels go several at once.
  const uint32_t* words = words_.data();
  const float* shares = shares_.data();
  const int width = image_size_.width;
  // By way of int: processors have no conversion from uint32_t.
  const auto tile_level = [](uint32_t word, uint32_t tile) {
    return static_cast<float>(static_cast<int>(word >> 8U * tile & 0xFFU));
  };
  for (int x = 0; x < width; ++x) {
    const uint32_t word = words[x];
    const float right = shares[x];
    const float left = 1 - right;
    const float above = tile_level(word, 0) * left + tile_level(word, 1) * right;
    const float below = tile_level(word, 2) * left + tile_level(word, 3) * right;
    equalized[x] = RoundToLevel(above * (1 - share_below) + below * share_below);
  }
}

}  // namespace plm_vins

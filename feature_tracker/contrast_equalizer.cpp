// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/contrast_equalizer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

namespace plm_vins {
namespace {

constexpr double kClipLimit = 3.0;  // maximum of a histogram bin, relative to the mean bin
// Fixed-point formats of 16 bits, of which SIMD multiplies eight at once.
constexpr int kBlendedBits = 6;  // fractional bits
constexpr int kWeightBits = 14;
constexpr int kShareBits = 15;
constexpr int kPixelsAtOnce = 16;

int TileStart(int tile, int tiles, int size) { return tile * size / tiles; }

// Clips the histogram at `limit` and redistributes the excess over all levels.
template <typename Histogram>
void Clip(int limit, Histogram* histogram) {
  const int levels = static_cast<int>(histogram->size());
  int excess = 0;
  for (int& count : *histogram) {
    excess += std::max(count - limit, 0);
    count = std::min(count, limit);
  }
  for (int& count : *histogram) count += excess / levels;
  const int rest = excess % levels;
  const int step = std::max(levels / std::max(rest, 1), 1);
  for (int i = 0; i < rest; ++i) ++(*histogram)[i * step];
}

}  // namespace

ContrastEqualizer::ContrastEqualizer(const cv::Size& image_size)
    : size_(image_size), weights_(2 * image_size.width), pairs_(2 * image_size.width) {
  first_column_.fill(size_.width);
  for (int x = size_.width - 1; x >= 0; --x) {
    const Position position = PositionOf(x, size_.width);
    first_column_[position.tile] = x;
    const float scale = 1 << kWeightBits;
    weights_[2 * x + 1] = static_cast<int16_t>(std::lround(scale * position.share));
    weights_[2 * x] = static_cast<int16_t>((1 << kWeightBits) - weights_[2 * x + 1]);
  }
}

// Pixels beyond the centers of the outermost tiles use these tiles only.
ContrastEqualizer::Position ContrastEqualizer::PositionOf(int pixel, int size) {
  const float tiles = static_cast<float>(pixel) * kTiles / static_cast<float>(size) - 0.5F;
  const int tile = std::clamp(static_cast<int>(std::floor(tiles)), 0, kTiles - 2);
  return {tile, std::clamp(tiles - static_cast<float>(tile), 0.0F, 1.0F)};
}

void ContrastEqualizer::Apply(const cv::Mat& image, cv::Mat* equalized) {
  CV_Assert(image.type() == CV_8UC1 && image.size() == size_ && image.data != equalized->data);
  equalized->create(size_, CV_8UC1);
  FillTables(image);
  for (int y = 0; y < size_.height; ++y) {
    BlendTables(PositionOf(y, size_.height));
    EqualizeRow(image.ptr<uint8_t>(y), equalized->ptr<uint8_t>(y));
  }
}

void ContrastEqualizer::FillTables(const cv::Mat& image) {
  const auto range = [](int tile, int size) {
    return cv::Range(TileStart(tile, kTiles, size), TileStart(tile + 1, kTiles, size));
  };
  for (int row = 0; row < kTiles; ++row) {
    for (int column = 0; column < kTiles; ++column) {
      FillTable(image(range(row, size_.height), range(column, size_.width)), column, &tables_[row]);
    }
  }
}

void ContrastEqualizer::FillTable(const cv::Mat& tile, int tile_column, Table* table) const {
  // Two histograms, since neighboring pixels often have the same level, and incrementing the same
  // counter twice in a row stalls.
  std::array<std::array<int, kLevels>, 2> halves = {};
  for (int y = 0; y < tile.rows; ++y) {
    const auto* levels = tile.ptr<uint8_t>(y);
    for (int x = 0; x + 1 < tile.cols; x += 2) {
      ++halves[0][levels[x]];
      ++halves[1][levels[x + 1]];
    }
    if (tile.cols % 2 == 1) ++halves[0][levels[tile.cols - 1]];
  }
  std::array<int, kLevels>& histogram = halves[0];
  for (int i = 0; i < kLevels; ++i) histogram[i] += halves[1][i];
  const int area = tile.rows * tile.cols;
  Clip(std::max(static_cast<int>(kClipLimit * area / kLevels), 1), &histogram);
  const float scale = static_cast<float>(kLevels - 1) / static_cast<float>(area);
  int sum = 0;
  for (int i = 0; i < kLevels; ++i) {
    sum += histogram[i];
    (*table)[i][tile_column] = cv::saturate_cast<uint8_t>(static_cast<float>(sum) * scale);
  }
}

// Adds half a gray level, so that truncating the fractional bits later rounds.
void ContrastEqualizer::BlendTables(const Position& row) {
  constexpr int kOne = 1 << kShareBits;
  constexpr int kDifferenceBits = 16 - kShareBits + kBlendedBits;
  const cv::v_int16x8 share = cv::v_setall_s16(static_cast<int16_t>(
      std::min(static_cast<int>(row.share * static_cast<float>(kOne)), kOne - 1)));
  const cv::v_int16x8 half = cv::v_setall_s16(1 << (kBlendedBits - 1));
  for (int i = 0; i < kLevels; ++i) {
    const cv::v_int16x8 upper = cv::v_load(tables_[row.tile][i].data());
    const cv::v_int16x8 lower = cv::v_load(tables_[row.tile + 1][i].data());
    const cv::v_int16x8 difference = cv::v_shl<kDifferenceBits>(cv::v_sub_wrap(lower, upper));
    const cv::v_int16x8 start = cv::v_add_wrap(cv::v_shl<kBlendedBits>(upper), half);
    cv::v_store(blended_[i].data(), cv::v_add_wrap(start, cv::v_mul_hi(difference, share)));
  }
}

void ContrastEqualizer::EqualizeRow(const uint8_t* levels, uint8_t* equalized) {
  int16_t* pairs = pairs_.data();
  for (int tile = 0; tile + 1 < kTiles; ++tile) {
    const int16_t* table = blended_.front().data() + tile;
    for (int x = first_column_[tile]; x < first_column_[tile + 1]; ++x) {
      std::memcpy(&pairs[2 * x], table + kTiles * levels[x], 2 * sizeof(int16_t));
    }
  }
  constexpr int kShift = kBlendedBits + kWeightBits;
  int x = 0;
  const auto four = [&](int first) {
    const int i = 2 * (x + first);
    return cv::v_shr<kShift>(cv::v_dotprod(cv::v_load(pairs + i), cv::v_load(weights_.data() + i)));
  };
  for (; x + kPixelsAtOnce <= size_.width; x += kPixelsAtOnce) {
    cv::v_store(equalized + x,
                cv::v_pack_u(cv::v_pack(four(0), four(4)), cv::v_pack(four(8), four(12))));
  }
  for (; x < size_.width; ++x) {
    const int sum = pairs[2 * x] * weights_[2 * x] + pairs[2 * x + 1] * weights_[2 * x + 1];
    equalized[x] = static_cast<uint8_t>(sum >> kShift);
  }
}

}  // namespace plm_vins

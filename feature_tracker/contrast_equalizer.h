// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins {

// Contrast-limited adaptive histogram equalisation [Zuiderveld1994] with 8 x 8 tiles: the bytes
// that cv::CLAHE gives (but for roundings where the compiler fuses products and sums), in half the
// time. The tables of the four tiles around a pixel lie in one word, so that one look-up reads all.
class ContrastEqualizer {
 public:
  explicit ContrastEqualizer(const cv::Size& image_size);

  // `image` is CV_8UC1 and of the size above; so is the result.
  cv::Mat Equalize(const cv::Mat& image);

 private:
  static constexpr int kTiles = 8;           // in a row or column
  static constexpr int kCells = kTiles + 1;  // between the tiles' centres, and beyond the outermost
  static constexpr int kLevels = 256;        // of grey
  static constexpr double kClipLimit = 3.0;  // of a level's pixels, times the mean of all levels
  using Histogram = std::array<int, kLevels>;
  using Table = std::array<uint8_t, kLevels>;       // from level to equalised level
  using CellTable = std::array<uint32_t, kLevels>;  // to those of four tiles, a byte each

  // Where a pixel lies between the centres of the tiles before and after it, in one direction.
  struct Place {
    int cell = 0;     // the tile after it
    float share = 0;  // of the way to that one
  };
  static Place Locate(int pixel, int tile_length);

  cv::Mat Extend(const cv::Mat& image) const;
  static Histogram CountLevels(const cv::Mat& tile);
  void Clip(Histogram* histogram) const;
  Table MakeTable(const cv::Mat& tile) const;
  void JoinTables(int cell_row);
  void LookUp(const uint8_t* row);
  void Interpolate(float share_below, uint8_t* equalized) const;

  // Read-only after construction.
  cv::Size image_size_;
  cv::Size margin_;  // to the right and below, which makes all tiles equally large
  cv::Size tile_size_;
  std::vector<float> shares_;                    // of each column's place
  std::array<int, kCells + 1> first_columns_{};  // of the cells

  // Buffers.
  std::array<std::array<Table, kTiles>, kTiles> tables_{};  // by row and column of the tiles
  std::array<CellTable, kCells> cell_tables_{};             // of one row of cells
  std::vector<uint32_t> words_;                             // looked up for one row of pixels
};

}  // namespace plm_vins

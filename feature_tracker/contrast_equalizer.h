// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins {

// Contrast limited adaptive histogram equalisation (CLAHE, [Zuiderveld1994]) of grey images of one
// size: to one grey level what cv::CLAHE gives, in half the time. The tables of neighbouring tiles
// are blended down the image once per row, then per pixel only across. Tiles of a size that is not
// divisible by their number differ by a pixel; OpenCV extends the image instead.
class ContrastEqualizer {
 public:
  explicit ContrastEqualizer(const cv::Size& image_size);

  // `image` is CV_8UC1 of the size given, at least eight pixels each way. Not in place.
  void Apply(const cv::Mat& image, cv::Mat* equalized);

 private:
  static constexpr int kTiles = 8;  // each way
  static constexpr int kLevels = 256;
  // What becomes of a grey level in the tiles side by side.
  using Table = std::array<std::array<int16_t, kTiles>, kLevels>;

  // Between which two tiles a row or column lies: the one before, and the share of the one after.
  struct Position {
    int tile = 0;
    float share = 0;
  };

  static Position PositionOf(int pixel, int size);
  void FillTables(const cv::Mat& image);
  void FillTable(const cv::Mat& tile, int tile_column, Table* table) const;
  void BlendTables(const Position& row);
  void EqualizeRow(const uint8_t* levels, uint8_t* equalized);

  cv::Size size_;
  std::array<int, kTiles> first_column_ = {};  // of those that lie between a tile and the next
  std::vector<int16_t> weights_;               // of these two, per column
  std::array<Table, kTiles> tables_ = {};      // of the rows of tiles
  Table blended_ = {};                         // for one row of pixels, finer than grey levels
  std::vector<int16_t> pairs_;                 // of that row, what both tiles make of the pixel
};

}  // namespace plm_vins

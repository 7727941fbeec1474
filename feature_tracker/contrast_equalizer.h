// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins {

// Contrast limited adaptive histogram equalization (CLAHE, [Zuiderveld1994]) for gray images of a
// fixed size. Results agree with cv::CLAHE to one gray level, in half the time: the lookup tables
// of vertically adjacent tiles are blended once per image row, and pixels are interpolated only
// horizontally. If the image size is not divisible by the number of tiles, tile sizes differ by one
// pixel; OpenCV pads the image instead.
class ContrastEqualizer {
 public:
  explicit ContrastEqualizer(const cv::Size& image_size);

  // `image` is CV_8UC1 of the given size, at least 8 x 8 pixels. Does not work in place.
  void Apply(const cv::Mat& image, cv::Mat* equalized);

 private:
  static constexpr int kTiles = 8;  // in each direction
  static constexpr int kLevels = 256;
  // Output level for each input level, in all tiles of a row.
  using Table = std::array<std::array<int16_t, kTiles>, kLevels>;

  // Position of a row or column between two tile centers: the preceding tile and the weight of the
  // next.
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
  std::array<int, kTiles> first_column_ = {};  // first column after the tile's center
  std::vector<int16_t> weights_;  // interpolation weights of the two tiles, for each column
  std::array<Table, kTiles> tables_ = {};  // lookup tables, one for each row of tiles
  Table blended_ = {};                     // for the current image row, with fractional bits
  std::vector<int16_t> pairs_;  // outputs of the two tiles for each pixel of the current row
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

namespace plm_vins {

// Brightness between pixels of a CV_8UC1 image, bilinear. The point must lie inside of the image,
// by less than its last row and column.
inline float Interpolate(const cv::Mat& image, float x, float y) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const float dx = x - static_cast<float>(column);
  const float dy = y - static_cast<float>(row);
  const uint8_t* upper = image.data + row * image.step[0] + column;
  const uint8_t* lower = upper + image.step[0];
  const float top = static_cast<float>(upper[0]) + dx * static_cast<float>(upper[1] - upper[0]);
  const float bottom = static_cast<float>(lower[0]) + dx * static_cast<float>(lower[1] - lower[0]);
  return top + dy * (bottom - top);
}

// True where a profile of this radius around the point can be interpolated in any direction.
inline bool IsInterpolable(const cv::Mat& image, float x, float y, float radius) {
  return x >= radius && y >= radius && x < static_cast<float>(image.cols - 1) - radius &&
         y < static_cast<float>(image.rows - 1) - radius;
}

}  // namespace plm_vins

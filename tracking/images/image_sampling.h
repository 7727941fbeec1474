// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstring>
#include <opencv2/core.hpp>

namespace plm_vins {

// Bilinear interpolation of a CV_8UC1 image. The point must be inside the image, before its last
// row and column.
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

// Interpolates `count` equidistant points, with different rounding in the last bits, and pads with
// zeros to kStride. The loops are written such that the compiler vectorizes all but the loading of
// pixels.
template <int kStride>
void InterpolateRow(const cv::Mat& image, const cv::Point2f& start, const cv::Point2f& step,
                    int count, float* brightness) {
  const int row_step = static_cast<int>(image.step[0]);
  float dx[kStride], dy[kStride];
  int offset[kStride];
  for (int i = 0; i < kStride; ++i) {
    const float x = start.x + static_cast<float>(i) * step.x;
    const float y = start.y + static_cast<float>(i) * step.y;
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    dx[i] = x - static_cast<float>(column);
    dy[i] = y - static_cast<float>(row);
    offset[i] = row * row_step + column;
  }
  // Loads each pixel together with its right neighbor, which is the higher byte.
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
  std::array<uint16_t, kStride> upper = {}, lower = {};
  for (int i = 0; i < count; ++i) {
    const uint8_t* pixel = image.data + offset[i];
    std::memcpy(&upper[i], pixel, 2);
    std::memcpy(&lower[i], pixel + row_step, 2);
  }
  for (int i = 0; i < kStride; ++i) {
    const float top = static_cast<float>(upper[i] & 0xFF) +
                      dx[i] * static_cast<float>((upper[i] >> 8) - (upper[i] & 0xFF));
    const float bottom = static_cast<float>(lower[i] & 0xFF) +
                         dx[i] * static_cast<float>((lower[i] >> 8) - (lower[i] & 0xFF));
    brightness[i] = top + dy[i] * (bottom - top);
  }
}

// Returns whether a profile of this radius around the point can be interpolated in any direction.
inline bool IsInterpolable(const cv::Mat& image, float x, float y, float radius) {
  return x >= radius && y >= radius && x < static_cast<float>(image.cols - 1) - radius &&
         y < static_cast<float>(image.rows - 1) - radius;
}

}  // namespace plm_vins

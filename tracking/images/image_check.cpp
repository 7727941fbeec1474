// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/images/image_check.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "common/camera/image_format.h"
#include "common/format.h"

namespace plm_vins {

void CheckImage(const ImageSample& image, const CameraParameters& camera,
                const std::optional<int64_t>& previous_ns) {
  CheckImageFormat(image.gray, camera);
  if (previous_ns && image.t_ns <= *previous_ns) {
    throw std::invalid_argument("image stamp " + std::to_string(image.t_ns) +
                                " ns is not after the previous one, " +
                                std::to_string(*previous_ns) + " ns");
  }
}

std::string DescribeIfFlat(const cv::Mat& gray) {
  constexpr int kStride = 16;     // of the sampled rows and columns [px]
  constexpr int kLeastRange = 8;  // of the gray values, 0 to 255
  int least = 255, largest = 0;
  for (int row = kStride / 2; row < gray.rows; row += kStride) {
    const uint8_t* pixels = gray.ptr(row);
    for (int col = kStride / 2; col < gray.cols; col += kStride) {
      least = std::min<int>(least, pixels[col]);
      largest = std::max<int>(largest, pixels[col]);
    }
  }
  if (largest - least >= kLeastRange || largest < least) return "";
  return Format(
      "all values are from %d to %d of 255; check exposure, lens cap and encoding: "
      "mono16 with 10 or 12 bits, or YUYV named yuv422?",
      least, largest);
}

std::string DescribeIfBayer(const cv::Mat& gray) {
  constexpr int kStride = 64;    // of the sampled rows [px]
  constexpr int64_t kRatio = 2;  // at most 1 without a pattern, whatever the noise
  int64_t next = 0, second_next = 0, below = 0, second_below = 0;
  for (int row = 0; row + 2 < gray.rows; row += kStride) {
    const uint8_t *pixels = gray.ptr(row), *first = gray.ptr(row + 1), *second = gray.ptr(row + 2);
    for (int col = 0; col + 2 < gray.cols; ++col) {
      next += std::abs(pixels[col] - pixels[col + 1]);
      second_next += std::abs(pixels[col] - pixels[col + 2]);
      below += std::abs(pixels[col] - first[col]);
      second_below += std::abs(pixels[col] - second[col]);
    }
  }
  if (next <= kRatio * second_next || below <= kRatio * second_below) return "";
  return "neighboring pixels alternate as in a raw Bayer image; its encoding must say so "
         "(bayer_rggb8, ...), or the driver must send mono8 or bgr8";
}

bool AreSame(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size()) return false;
  for (int row = 0; row < a.rows; ++row) {
    if (!std::equal(a.ptr(row), a.ptr(row) + a.cols, b.ptr(row))) return false;
  }
  return true;
}

}  // namespace plm_vins

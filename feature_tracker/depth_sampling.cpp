// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/depth_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core/fast_math.hpp>

namespace plm_vins {
namespace {

constexpr int kMinValid = 7;  // least number of valid values among the nine
// Largest half range of the values relative to the depth; allows for noise and slant.
constexpr double kMaxDeviation = 0.05;

// Returns the depth in meters; zero if it is unknown or at the limit of the type.
double ValueAt(const cv::Mat& depth, int row, int column, double unit) {
  if (depth.type() == CV_16UC1) {
    const uint16_t value = depth.at<uint16_t>(row, column);
    return value == std::numeric_limits<uint16_t>::max() ? 0 : unit * value;
  }
  const double value = depth.at<float>(row, column);
  return std::isfinite(value) && value > 0 ? value : 0.0;
}

}  // namespace

std::optional<double> DepthAt(const cv::Mat& depth, const cv::Point2f& pixel, double unit) {
  const int column = cvRound(pixel.x), row = cvRound(pixel.y);
  if (column < 1 || row < 1 || column + 1 >= depth.cols || row + 1 >= depth.rows) {
    return std::nullopt;
  }
  std::array<double, 9> values = {};
  int count = 0;
  for (int y = row - 1; y <= row + 1; ++y) {
    for (int x = column - 1; x <= column + 1; ++x) {
      const double value = ValueAt(depth, y, x, unit);
      if (value > 0) values[count++] = value;
    }
  }
  if (count < kMinValid) return std::nullopt;
  std::sort(values.begin(), values.begin() + count);
  const double median = values[count / 2];
  const double deviation = std::max(median - values[0], values[count - 1] - median);
  return deviation <= kMaxDeviation * median ? std::optional(median) : std::nullopt;
}

}  // namespace plm_vins

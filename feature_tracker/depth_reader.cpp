// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/depth_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <opencv2/core/fast_math.hpp>

#include "common/format.h"

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

constexpr int kMinDepths = 20;  // fewer may be equal by chance, or all miss
constexpr int kLasting = 20;    // consecutive images: a second

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

void DepthReader::Read(const cv::Mat& image, double unit, std::vector<PointTrack>* tracks) {
  std::vector<double> depths;
  for (PointTrack& track : *tracks) {
    track.depth = DepthAt(image, track.uv_px, unit);
    if (track.depth) depths.push_back(*track.depth);
  }
  if (image.empty()) return;
  const bool is_tracking = static_cast<int>(tracks->size()) >= kMinDepths;
  without_ = depths.empty() ? without_ + is_tracking : 0;
  const bool is_constant =
      static_cast<int>(depths.size()) >= kMinDepths &&
      std::adjacent_find(depths.begin(), depths.end(), std::not_equal_to<>()) == depths.end();
  constant_ = is_constant ? constant_ + 1 : 0;
  if (!is_constant) return;
  constant_depth_ = depths.front();
  for (PointTrack& track : *tracks) track.depth.reset();
}

std::string DepthReader::Finding() const {
  if (constant_ >= kLasting) {
    return Format(
        "depth images have the same value everywhere, %.3f m: no measurement; check the "
        "driver of the depth sensor",
        constant_depth_);
  }
  if (without_ < kLasting) return "";
  return "depth images have no valid value at any corner: all are 0, NaN, infinite, negative, or "
         "the largest integer; check depth_topic, the sensor, and its range";
}

}  // namespace plm_vins

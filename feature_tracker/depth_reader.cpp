// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/depth_reader.h"

#include <algorithm>
#include <functional>

#include "common/format.h"
#include "feature_tracker/depth_sampling.h"

namespace plm_vins {
namespace {

constexpr int kMinDepths = 20;  // fewer may be equal by chance, or all miss
constexpr int kLasting = 20;    // consecutive images: a second

}  // namespace

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

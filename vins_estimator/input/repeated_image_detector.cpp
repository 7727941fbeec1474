// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/repeated_image_detector.h"

#include <algorithm>
#include <vector>

#include "common/features/common_points.h"

namespace plm_vins {
namespace {

constexpr int kMinCorners = 10;     // in both images
constexpr double kMinSpeed = 0.05;  // [m/s]

bool ShowTheSame(const PointFrame& before, const PointFrame& after) {
  const std::vector<CommonPoint> common = CommonPoints(before, after);
  return common.size() >= kMinCorners &&
         std::all_of(common.begin(), common.end(), [](const CommonPoint& point) {
           return point.first->uv_px == point.second->uv_px;
         });
}

}  // namespace

bool RepeatedImageDetector::Add(const FrameMeasurement& measurement, double least_speed) {
  imu_.Add(measurement);
  const bool same = ShowTheSame(before_, measurement.points);
  before_ = measurement.points;
  const bool moves = least_speed > kMinSpeed || (imu_.IsKnown() && !imu_.IsQuiet());
  return same && moves;
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/repeated_image_detector.h"

#include <unordered_map>

namespace plm_vins {
namespace {

constexpr int kMinCorners = 10;     // in both images
constexpr double kMinSpeed = 0.05;  // [m/s]

bool ShowTheSame(const PointFrame& before, const PointFrame& after) {
  std::unordered_map<int64_t, Eigen::Vector2d> places;
  for (const PointObservation& point : before.points) places.emplace(point.id, point.uv_px);
  int common = 0;
  for (const PointObservation& point : after.points) {
    const auto place = places.find(point.id);
    if (place == places.end()) continue;
    if (place->second != point.uv_px) return false;
    ++common;
  }
  return common >= kMinCorners;
}

}  // namespace

bool RepeatedImageDetector::Add(const FrameMeasurement& measurement, double least_speed) {
  imu_.Add(measurement);
  const bool same = ShowTheSame(before_, measurement.points);
  before_ = measurement.points;
  const bool moves = least_speed > kMinSpeed || (imu_.IsKnown() && !imu_.IsQuiet());
  return same && moves;
}

void RepeatedImageDetector::Reset() {
  imu_.Reset();
  before_.points.clear();
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// Two observations of a point.
struct CommonPoint {
  const PointObservation* first;
  const PointObservation* second;
};

// Returns the points that a camera observes in both frames, in the order of the second one. Both
// must outlive the result.
inline std::vector<CommonPoint> CommonPoints(const PointFrame& first, const PointFrame& second) {
  std::unordered_map<int64_t, const PointObservation*> by_track;
  for (const PointObservation& point : first.points) by_track.emplace(TrackKey(point), &point);
  std::vector<CommonPoint> common;
  for (const PointObservation& point : second.points) {
    const auto before = by_track.find(TrackKey(point));
    if (before != by_track.end()) common.push_back({before->second, &point});
  }
  return common;
}

// Returns those of the camera with the most, because motions in several images do not add up.
inline std::vector<CommonPoint> CommonPointsOfOneCamera(const PointFrame& first,
                                                        const PointFrame& second) {
  const std::vector<CommonPoint> all = CommonPoints(first, second);
  std::array<std::vector<CommonPoint>, kMaxCameras> by_camera;
  for (const CommonPoint& point : all) by_camera[point.first->camera].push_back(point);
  return *std::max_element(by_camera.begin(), by_camera.end(),
                           [](const auto& a, const auto& b) { return a.size() < b.size(); });
}

}  // namespace plm_vins

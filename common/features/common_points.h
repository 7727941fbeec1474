// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace plm_vins

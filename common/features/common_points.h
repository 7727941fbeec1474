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

// Returns the points observed in both images, in the order of the second one. Both must outlive the
// result.
inline std::vector<CommonPoint> CommonPoints(const PointFrame& first, const PointFrame& second) {
  std::unordered_map<int64_t, const PointObservation*> by_id;
  for (const PointObservation& point : first.points) by_id.emplace(point.id, &point);
  std::vector<CommonPoint> common;
  for (const PointObservation& point : second.points) {
    const auto before = by_id.find(point.id);
    if (before != by_id.end()) common.push_back({before->second, &point});
  }
  return common;
}

}  // namespace plm_vins

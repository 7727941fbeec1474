// SPDX-License-Identifier: BSD-3-Clause
// Which features can be true: those that trackers give, and others take from elsewhere.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

constexpr double kMaxImageCoordinate = 100;  // normalised: half a degree from the image plane
constexpr double kMaxPixel = 1e5;            // no image is as large
constexpr double kMaxImageVelocity = 1e4;    // [1/s], at that place where the camera spins
constexpr size_t kMaxFeatures = 5000;        // of an image: as max_cnt and max_line_cnt may ask for

// False for what is not finite, too.
inline bool IsWithin(const Eigen::Vector2d& xy, double limit) {
  return xy.allFinite() && xy.cwiseAbs().maxCoeff() <= limit;
}

inline bool IsPossible(const PointObservation& point) {
  return IsWithin(point.xy, kMaxImageCoordinate) && IsWithin(point.velocity, kMaxImageVelocity) &&
         IsWithin(point.uv_px, kMaxPixel);
}

inline bool IsPossible(const LineObservation& line) {
  return IsWithin(line.start, kMaxImageCoordinate) && IsWithin(line.end, kMaxImageCoordinate);
}

// Whether it can be true, and its id is none of `ids`, which it joins.
template <typename Observation>
bool IsPossibleAndNew(const Observation& observation, std::unordered_set<int64_t>* ids) {
  return IsPossible(observation) && ids->insert(observation.id).second;
}

// Removes impossible observations, those of an id that is in the image already, and those beyond
// the first kMaxFeatures. Returns how many went.
template <typename Observation>
int64_t RemoveImpossible(std::vector<Observation>* observations) {
  std::unordered_set<int64_t> ids;
  std::vector<Observation> possible;
  possible.reserve(std::min(observations->size(), kMaxFeatures));
  for (const Observation& observation : *observations) {
    if (possible.size() == kMaxFeatures) break;
    if (IsPossibleAndNew(observation, &ids)) possible.push_back(observation);
  }
  const size_t removed = observations->size() - possible.size();
  observations->swap(possible);
  return static_cast<int64_t>(removed);
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
// Plausibility checks of features, from the trackers or from other programs.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

constexpr double kMaxImageCoordinate = 100;  // normalized: half a degree from the image plane
constexpr double kMaxPixel = 1e5;            // larger than any image
constexpr double kMaxDepth = 1e4;            // [m]
constexpr double kMaxImageVelocity = 1e4;    // [1/s], at kMaxImageCoordinate in fast rotation
constexpr size_t kMaxFeatures = 5000;        // per image; upper limit of max_cnt and max_line_cnt

// Returns whether both coordinates are finite and at most `limit` in magnitude.
inline bool IsWithin(const Eigen::Vector2d& xy, double limit) {
  return xy.allFinite() && xy.cwiseAbs().maxCoeff() <= limit;
}

inline bool IsCamera(int number) { return number >= 0 && number < kMaxCameras; }

inline bool IsPossible(const PointObservation& point) {
  return IsCamera(point.camera) && IsWithin(point.xy, kMaxImageCoordinate) &&
         IsWithin(point.velocity, kMaxImageVelocity) && IsWithin(point.uv_px, kMaxPixel) &&
         (!point.depth || (*point.depth > 0 && *point.depth <= kMaxDepth));
}

inline bool IsPossible(const LineObservation& line) {
  return IsCamera(line.camera) && IsWithin(line.start, kMaxImageCoordinate) &&
         IsWithin(line.end, kMaxImageCoordinate) && IsWithin(line.deviation, kMaxImageCoordinate) &&
         line.deviation.minCoeff() >= 0;
}

// Returns whether the observation is plausible and its track is not in `tracks`; inserts the track.
template <typename Observation>
bool IsPossibleAndNew(const Observation& observation, std::unordered_set<int64_t>* tracks) {
  return IsPossible(observation) && tracks->insert(TrackKey(observation)).second;
}

// Removes implausible observations, ids that a camera repeats, and observations beyond the first
// kMaxFeatures. Returns the number of removed observations.
template <typename Observation>
int64_t RemoveImpossible(std::vector<Observation>* observations) {
  std::unordered_set<int64_t> tracks;
  std::vector<Observation> possible;
  possible.reserve(std::min(observations->size(), kMaxFeatures));
  for (const Observation& observation : *observations) {
    if (possible.size() == kMaxFeatures) break;
    if (IsPossibleAndNew(observation, &tracks)) possible.push_back(observation);
  }
  const size_t removed = observations->size() - possible.size();
  observations->swap(possible);
  return static_cast<int64_t>(removed);
}

}  // namespace plm_vins

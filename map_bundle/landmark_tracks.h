// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pose_graph/keyframes/landmark_key.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Observation of a landmark, matched by a loop, in a keyframe of another visit.
struct Reobservation {
  LandmarkKey landmark;
  int keyframe = -1;                             // number in the map
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();  // normalized
};

struct LandmarkObservation {
  int keyframe = -1;  // number in the map
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();
  bool again = false;  // matched by a loop closure in another visit
};

// A landmark with its observations, at most one for each keyframe: first those of the track in
// keyframe order, then those of other visits.
struct LandmarkTrack {
  LandmarkKey key;
  Eigen::Vector3d p_M = Eigen::Vector3d::Zero();  // [m]
  std::vector<LandmarkObservation> observations;
};

// Collects the landmarks of `keyframes` (in ascending order) that have enough parallax and positive
// depth in each observing camera, ordered by key.
std::vector<LandmarkTrack> CollectLandmarks(const KeyframeMap& map,
                                            const std::vector<int>& keyframes,
                                            const std::vector<Reobservation>& again);

}  // namespace plm_vins

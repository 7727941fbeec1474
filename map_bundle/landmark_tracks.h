// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pose_graph/keyframes/landmark_key.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// A landmark that a loop found in a keyframe of another visit.
struct SightingAgain {
  LandmarkKey landmark;
  int keyframe = -1;                             // by number
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();  // normalised
};

struct LandmarkSighting {
  int keyframe = -1;  // by number
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();
  bool again = false;  // of another visit
};

// A landmark with all that is seen of it, once by each keyframe: first by the track, in order of
// keyframes, then again.
struct LandmarkTrack {
  LandmarkKey key;
  Eigen::Vector3d p_M = Eigen::Vector3d::Zero();  // [m]
  std::vector<LandmarkSighting> sightings;
};

// The landmarks of these keyframes, which are given in order, that are seen from two sides and lie
// before each camera that sees them. In order of their keys.
std::vector<LandmarkTrack> CollectLandmarks(const KeyframeMap& map,
                                            const std::vector<int>& keyframes,
                                            const std::vector<SightingAgain>& again);

}  // namespace plm_vins

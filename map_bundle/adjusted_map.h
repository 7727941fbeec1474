// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "common/geometry/rigid3.h"
#include "map_bundle/landmark_tracks.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Result of the map bundle adjustment.
struct AdjustedMap {
  std::vector<Rigid3d> T_B_C{Rigid3d()};       // by camera; shared by all adjusted keyframes
  std::map<int, Rigid3d> T_M_B;                // adjusted keyframes only, by number
  std::map<LandmarkKey, Eigen::Vector3d> p_M;  // [m]
};

// Moves the graph's nodes to the adjusted keyframe poses. The keyframes keep their odometry poses,
// so that odometry poses between keyframes can still be corrected.
void MoveNodes(const AdjustedMap& adjusted, KeyframeMap* map);

// Returns the map, after MoveNodes(), as the starting map of another run: odometry poses, landmarks
// and T_B_C are replaced by the adjusted ones. Keyframes that were not adjusted keep their poses.
KeyframeMap RebuiltMap(const AdjustedMap& adjusted, const KeyframeMap& map);

}  // namespace plm_vins

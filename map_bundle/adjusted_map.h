// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>

#include "common/geometry/rigid3.h"
#include "map_bundle/landmark_tracks.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// What the bundle found.
struct AdjustedMap {
  Rigid3d T_B_C;                               // of all keyframes that were adjusted
  std::map<int, Rigid3d> T_M_B;                // of these alone, by number
  std::map<LandmarkKey, Eigen::Vector3d> p_M;  // [m]
};

// Takes the graph's nodes to where the bundle has their keyframes. What odometry said stays, so
// that its poses between keyframes can still be corrected.
void MoveNodes(const AdjustedMap& adjusted, KeyframeMap* map);

// The map, its nodes moved by MoveNodes(), for another run to start in: with poses, landmarks and
// T_B_C as if odometry had found them so. Keyframes that were not adjusted stay where they are.
KeyframeMap RebuiltMap(const AdjustedMap& adjusted, const KeyframeMap& map);

}  // namespace plm_vins

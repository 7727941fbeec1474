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
  std::map<int, Rigid3d> T_M_B;                // by number of the keyframe
  std::map<LandmarkKey, Eigen::Vector3d> p_M;  // [m]
};

// Takes the graph's nodes to where the bundle has their keyframes. What odometry said stays, so
// that its poses between keyframes can still be corrected.
void MoveNodes(const AdjustedMap& adjusted, KeyframeMap* map);

// The map, its nodes moved by MoveNodes(), for another run to start in: the keyframes that are
// kept, with poses and landmarks as if odometry had found them so.
KeyframeMap RebuiltMap(const AdjustedMap& adjusted, const KeyframeMap& map);

}  // namespace plm_vins

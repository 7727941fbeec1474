// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/graph/pose_graph.h"
#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {

// Keyframes and the graph that joins them: what a map file holds.
struct KeyframeMap {
  std::vector<Keyframe> keyframes;
  PoseGraph graph;  // node i is keyframe i

  // Forgets what a keyframe saw and takes it out of the graph; its pose stays known, as seen from
  // `anchor`.
  void Remove(int keyframe, int anchor);

  int CountKept() const;

  // Of those that are not removed and joined to the first one, in order.
  std::vector<int> NumbersInMap() const;

  // Of those alone that were not removed, numbered anew.
  KeyframeMap Compact() const;

  // Where the world of a keyframe's odometry was in the map when it was taken, as known now.
  LevelTransform T_M_O(int keyframe) const {
    return graph.node(keyframe) * keyframes[keyframe].T_O_L().Inverse();
  }

  // Where the camera was.
  Rigid3d T_M_C(int keyframe) const {
    return T_M_O(keyframe).ToRigid() * keyframes[keyframe].T_O_C();
  }
};

}  // namespace plm_vins

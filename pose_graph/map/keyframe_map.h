// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/graph/pose_graph.h"
#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {

// Keyframes and their pose graph: the content of a map file.
struct KeyframeMap {
  std::vector<Keyframe> keyframes;
  PoseGraph graph;  // node i is keyframe i

  // Removes a keyframe: deletes its features and removes it from the graph. Its pose is kept
  // relative to `anchor`.
  void Remove(int keyframe, int anchor);

  int CountKept() const;

  // Numbers of the keyframes that were not removed and are connected with the first one, in
  // ascending order.
  std::vector<int> NumbersInMap() const;

  // Returns a copy without removed keyframes, renumbered.
  KeyframeMap Compact() const;

  // Current estimate of the map pose of the odometry world O at the time of this keyframe; drift
  // changes it from keyframe to keyframe.
  LevelTransform T_M_O(int keyframe) const {
    return graph.node(keyframe) * keyframes[keyframe].T_O_L().Inverse();
  }

  // Camera pose in the map.
  Rigid3d T_M_C(const MapImage& image) const {
    return T_M_O(image.keyframe).ToRigid() * keyframes[image.keyframe].T_O_C(image.camera);
  }
};

}  // namespace plm_vins

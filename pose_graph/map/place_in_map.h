// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/graph/level_edge.h"
#include "pose_graph/keyframes/odometry_noise.h"
#include "pose_graph/map/keyframe_map.h"
#include "pose_graph/map/map_fix.h"

namespace plm_vins {

// How surely the places of keyframes in the map M are known. Odometry leads on from an anchor: from
// the first keyframe of its world, or from one that a loop told the place of. A map that was loaded
// is exact by definition.
class PlaceInMap {
 public:
  explicit PlaceInMap(const OdometryNoise& noise) : noise_(noise) {}

  // The keyframes of a map that was loaded.
  void SetMap(const KeyframeMap& map);

  // Takes the newest keyframe of the map; `continues`: there are others of its world.
  void AddKeyframe(const KeyframeMap& map, bool continues);

  // Takes a loop of the map's graph that leads to a keyframe of the newest world; `joins`: that
  // world has a place in M by now, and had none before.
  void AddLoop(const KeyframeMap& map, const LevelEdge& loop, bool joins);

  // Of the newest world, if it has a place in M.
  MapFix Fix(const KeyframeMap& map) const { return FixBy(map, anchor_, covariances_[anchor_]); }

 private:
  // As if the place of that keyframe were known so well.
  MapFix FixBy(const KeyframeMap& map, int anchor, const Matrix4d& covariance) const;
  Matrix4d CovarianceOf(const Keyframe& keyframe, const MapFix& fix) const;

  OdometryNoise noise_;
  std::vector<Matrix4d> covariances_;  // by keyframe: of (x, y, z, yaw) in M
  int anchor_ = 0;
};

}  // namespace plm_vins

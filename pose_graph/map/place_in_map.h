// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
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

  // Takes the newest keyframe of the map.
  void AddKeyframe(const KeyframeMap& map);

  // Takes a loop of the map's graph that leads to a keyframe of the newest world; `joins`: that
  // world has a place in M by now, and had none before.
  void AddLoop(const KeyframeMap& map, const LevelEdge& loop, bool joins);

  // Goes over all keyframes anew, and over the loops that are left in the map's graph: of what one
  // told that the graph has dropped, nothing stays.
  void Recompute(const KeyframeMap& map);

  // Of the newest world, if it has a place in M.
  MapFix Fix(const KeyframeMap& map) const { return FixBy(map, anchor_, covariances_[anchor_]); }

 private:
  int newest() const { return static_cast<int>(covariances_.size()) - 1; }
  // As if the place of that keyframe were known so well.
  MapFix FixBy(const KeyframeMap& map, int anchor, const Matrix4d& covariance) const;
  Matrix4d CovarianceOf(const Keyframe& keyframe, const MapFix& fix) const;

  OdometryNoise noise_;
  std::vector<Matrix4d> covariances_;  // by keyframe: of (x, y, z, yaw) in M
  size_t loaded_ = 0;                  // keyframes
  int anchor_ = 0;
};

}  // namespace plm_vins

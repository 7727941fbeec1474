// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/graph/level_edge.h"
#include "pose_graph/keyframes/odometry_noise.h"
#include "pose_graph/map/keyframe_map.h"
#include "pose_graph/map/map_fix.h"

namespace plm_vins {

// Tracks the covariances of keyframe poses in the map M, or in the frame of their own part (a
// connected component of the pose graph) until a loop connects it with M. Odometry continues from
// an anchor: the first keyframe of its world, or the last one whose pose a loop has improved. A
// loaded map is exact by definition.
class PlaceInMap {
 public:
  explicit PlaceInMap(const OdometryNoise& noise) : noise_(noise) {}

  // Initializes from a loaded map.
  void SetMap(const KeyframeMap& map);

  // Adds the newest keyframe of the map.
  void AddKeyframe(const KeyframeMap& map);

  // Adds a loop to a keyframe of the newest world. If it connects two parts, the covariances of the
  // later part are derived from it; those of the part of M are unchanged.
  void AddLoop(const KeyframeMap& map, const LevelEdge& loop);

  // Recomputes all covariances from the loops that remain in the map's graph, which discards the
  // influence of dropped loops.
  void Recompute(const KeyframeMap& map);

  // Fix of the newest world, valid if its part is connected with M.
  MapFix Fix(const KeyframeMap& map) const { return FixBy(map, anchor_, Covariance(anchor_)); }

 private:
  struct Place {
    Matrix4d covariance;  // covariance of (x, y, z, yaw) in the frame of the part
    int part = 0;         // first keyframe of the world that defines the part's frame; 0 is M
  };

  int newest() const { return static_cast<int>(places_.size()) - 1; }
  const Matrix4d& Covariance(int keyframe) const { return places_[keyframe].covariance; }
  // Updates the covariances with a loop between two keyframes of the same part.
  void Improve(const KeyframeMap& map, const LevelEdge& loop);
  // Merges the part of the loop's end into that of its start.
  void Join(const KeyframeMap& map, const LevelEdge& loop);
  // Returns the fix of the newest world if `anchor` had this covariance.
  MapFix FixBy(const KeyframeMap& map, int anchor, const Matrix4d& covariance) const;
  Matrix4d CovarianceOf(const Keyframe& keyframe, const MapFix& fix) const;

  OdometryNoise noise_;
  std::vector<Place> loaded_;  // state after SetMap()
  std::vector<Place> places_;  // by keyframe number
  int anchor_ = 0;
};

}  // namespace plm_vins

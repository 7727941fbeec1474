// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/graph/level_edge.h"
#include "pose_graph/keyframes/odometry_noise.h"
#include "pose_graph/map/keyframe_map.h"
#include "pose_graph/map/map_fix.h"

namespace plm_vins {

// How surely the places of keyframes in the map M are known, or in the frame of their part, as long
// as no loop joins it to M. Odometry leads on from an anchor: from the first keyframe of its world,
// or from one that a loop told the place of. What was loaded of M is exact by definition.
class PlaceInMap {
 public:
  explicit PlaceInMap(const OdometryNoise& noise) : noise_(noise) {}

  // The keyframes of a map that was loaded.
  void SetMap(const KeyframeMap& map);

  // Takes the newest keyframe of the map.
  void AddKeyframe(const KeyframeMap& map);

  // Takes a loop of the map's graph that leads to a keyframe of the newest world. Of two parts that
  // it joins, the later one is known by it, but never that of M.
  void AddLoop(const KeyframeMap& map, const LevelEdge& loop);

  // Goes over all keyframes anew, and over the loops that are left in the map's graph: of what one
  // told that the graph has dropped, nothing stays.
  void Recompute(const KeyframeMap& map);

  // Of the newest world, if it has a place in M.
  MapFix Fix(const KeyframeMap& map) const { return FixBy(map, anchor_, Covariance(anchor_)); }

 private:
  struct Place {
    Matrix4d covariance;  // of (x, y, z, yaw) in the frame of its part
    int part = 0;         // by the keyframe whose world's frame it is: M is that of the first
  };

  int newest() const { return static_cast<int>(places_.size()) - 1; }
  const Matrix4d& Covariance(int keyframe) const { return places_[keyframe].covariance; }
  // Within one part.
  void Improve(const KeyframeMap& map, const LevelEdge& loop);
  // The part of the loop's end comes to that of its beginning.
  void Join(const KeyframeMap& map, const LevelEdge& loop);
  // As if the place of that keyframe were known so well.
  MapFix FixBy(const KeyframeMap& map, int anchor, const Matrix4d& covariance) const;
  Matrix4d CovarianceOf(const Keyframe& keyframe, const MapFix& fix) const;

  OdometryNoise noise_;
  std::vector<Place> loaded_;  // as they were when the map was loaded
  std::vector<Place> places_;  // by keyframe
  int anchor_ = 0;
};

}  // namespace plm_vins

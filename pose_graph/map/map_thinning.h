// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

struct MapThinningOptions {
  double min_age = 20;             // younger keyframes are always kept [s]
  double distance = 0.5;           // [m]
  double angle = 20 * M_PI / 180;  // [rad]
  double way = 3;  // maximum odometry path between them; longer ones drift too much [m]
  int enough = 5;  // keyframes that suffice for one viewpoint
};

// A redundant keyframe and the nearest of those that make it redundant.
struct DispensableKeyframe {
  int number = -1;
  int nearest = -1;
};

// Bounds the map's size by the explored space instead of the flight time: a keyframe that has
// become old is removed if enough earlier keyframes have a similar viewpoint. Each keyframe is
// examined once, so the oldest ones of a viewpoint are kept.
class MapThinning {
 public:
  explicit MapThinning(const MapThinningOptions& options) : options_(options) {}

  // Starts with a map that is already thinned: examines only the keyframes that were too young when
  // it was thinned.
  void StartBehind(const KeyframeMap& map);

  // Returns the next redundant keyframe that has become old, or nullopt. The caller must remove it
  // before the next call.
  std::optional<DispensableKeyframe> Next(const KeyframeMap& map);

 private:
  bool IsOld(const Keyframe& keyframe, const Keyframe& newest) const;
  std::vector<int> Like(const KeyframeMap& map, int number) const;

  MapThinningOptions options_;
  int next_ = 0;  // first keyframe not examined yet
};

}  // namespace plm_vins

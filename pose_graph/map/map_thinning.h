// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

struct MapThinningOptions {
  double min_age = 20;             // younger ones are neighbours of the newest one [s]
  double distance = 0.5;           // [m]
  double angle = 20 * M_PI / 180;  // [rad]
  double way = 3;                  // of odometry, a loop being none: more may be drift [m]
  int enough = 5;                  // keyframes for all that is seen from there
};

// A keyframe that is not needed, and of those that make up for it the nearest.
struct DispensableKeyframe {
  int number = -1;
  int nearest = -1;
};

// Keeps a map as large as the space that was seen, however long one flies there: a keyframe that
// has become old goes if enough of before show the same. Each is looked at once, so what was there
// first stays.
class MapThinning {
 public:
  explicit MapThinning(const MapThinningOptions& options) : options_(options) {}

  // A map that was thinned when it was made: looks only at those that were too young then.
  void StartBehind(const KeyframeMap& map);

  // The next one that has become old and is not needed; it must be removed before the next call.
  std::optional<DispensableKeyframe> Next(const KeyframeMap& map);

 private:
  bool IsOld(const Keyframe& keyframe, const Keyframe& newest) const;
  std::vector<int> Like(const KeyframeMap& map, int number) const;

  MapThinningOptions options_;
  int next_ = 0;  // not looked at yet
};

}  // namespace plm_vins

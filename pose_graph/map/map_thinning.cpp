// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/map_thinning.h"

#include <algorithm>

#include "common/measurements.h"

namespace plm_vins {

void MapThinning::StartBehind(const KeyframeMap& map) {
  next_ = static_cast<int>(map.keyframes.size());
  while (next_ > 0 && !IsOld(map.keyframes[next_ - 1], map.keyframes.back())) --next_;
}

std::optional<DispensableKeyframe> MapThinning::Next(const KeyframeMap& map) {
  while (IsOld(map.keyframes[next_], map.keyframes.back())) {
    const int number = next_++;
    const std::vector<int> like = Like(map, number);
    if (static_cast<int>(like.size()) < options_.enough) continue;
    const auto distance = [&](int other) {
      return (map.graph.node(other).translation - map.graph.node(number).translation).norm();
    };
    const auto is_nearer = [&](int a, int b) { return distance(a) < distance(b); };
    return DispensableKeyframe{number, *std::min_element(like.begin(), like.end(), is_nearer)};
  }
  return std::nullopt;
}

bool MapThinning::IsOld(const Keyframe& keyframe, const Keyframe& newest) const {
  return keyframe.world != newest.world ||
         ToSeconds(newest.t_ns - keyframe.t_ns) >= options_.min_age;
}

// Returns the earlier keyframes with a similar viewpoint and little drift in between.
std::vector<int> MapThinning::Like(const KeyframeMap& map, int number) const {
  const Rigid3d T_M_C = map.T_M_C({number, 0});
  std::vector<int> like;
  for (const int i : map.graph.Kept()) {
    if (i >= number) break;
    const Rigid3d other = map.T_M_C({i, 0});
    if ((other.translation - T_M_C.translation).norm() <= options_.distance &&
        other.rotation.angularDistance(T_M_C.rotation) <= options_.angle &&
        map.graph.Distance(number, i) <= options_.way) {
      like.push_back(i);
    }
  }
  return like;
}

}  // namespace plm_vins

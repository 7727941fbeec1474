// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/place_in_map.h"

#include <map>
#include <set>

namespace plm_vins {

void PlaceInMap::SetMap(const KeyframeMap& map) {
  loaded_ = map.keyframes.size();
  covariances_.assign(loaded_, Matrix4d::Zero());
}

void PlaceInMap::AddKeyframe(const KeyframeMap& map) {
  const size_t number = covariances_.size();
  const Keyframe& keyframe = map.keyframes[number];
  covariances_.push_back(keyframe.covariance);
  if (number > 0 && map.keyframes[number - 1].world == keyframe.world) {
    covariances_.back() = CovarianceOf(keyframe, Fix(map));
  } else {
    anchor_ = newest();
  }
}

// A loop that is less sure than odometry since the last one tells nothing new.
void PlaceInMap::AddLoop(const KeyframeMap& map, const LevelEdge& loop, bool joins) {
  const MapFix fix = FixBy(
      map, loop.to, CovarianceInMap(map.graph.node(loop.from), covariances_[loop.from], loop));
  const auto position_variance = [](const Matrix4d& covariance) {
    return covariance.topLeftCorner<3, 3>().trace();
  };
  const Keyframe& keyframe = map.keyframes[newest()];
  const Matrix4d newest_covariance = CovarianceOf(keyframe, fix);
  joins = joins && map.keyframes[loop.from].world != keyframe.world;
  if (!joins && position_variance(newest_covariance) >= position_variance(covariances_.back())) {
    return;
  }
  anchor_ = loop.to;
  covariances_[anchor_] = fix.covariance;
  covariances_.back() = newest_covariance;
  for (size_t i = 0; joins && i < covariances_.size(); ++i) {
    if (map.keyframes[i].world == keyframe.world) {
      covariances_[i] = CovarianceOf(map.keyframes[i], fix);
    }
  }
}

// As if each loop had come with the later of its keyframes. Those that were removed have passed
// theirs on to their neighbours.
void PlaceInMap::Recompute(const KeyframeMap& map) {
  std::multimap<int, LevelEdge> loops;  // by the later keyframe
  for (const LevelEdge& edge : map.graph.edges()) {
    if (!edge.is_loop) continue;
    const LevelEdge loop = edge.from < edge.to ? edge : Reversed(edge);
    loops.emplace(loop.to, loop);
  }
  covariances_.resize(loaded_);
  std::set<int> worlds = {map.keyframes.front().world};  // that have a place in M
  for (size_t i = 0; i < loaded_; ++i) worlds.insert(map.keyframes[i].world);
  while (covariances_.size() < map.keyframes.size()) {
    AddKeyframe(map);
    const auto [begin, end] = loops.equal_range(newest());
    for (auto loop = begin; loop != end; ++loop) {
      const bool joins = worlds.count(map.keyframes[loop->second.from].world) > 0 &&
                         worlds.insert(map.keyframes[newest()].world).second;
      AddLoop(map, loop->second, joins);
    }
  }
}

MapFix PlaceInMap::FixBy(const KeyframeMap& map, int anchor, const Matrix4d& covariance) const {
  const Keyframe& keyframe = map.keyframes[anchor];
  return {map.T_M_O(newest()), keyframe.T_O_L(), keyframe.covariance, covariance, noise_};
}

Matrix4d PlaceInMap::CovarianceOf(const Keyframe& keyframe, const MapFix& fix) const {
  return LevelCovarianceInMap(fix, keyframe.T_O_B.translation, keyframe.covariance);
}

}  // namespace plm_vins

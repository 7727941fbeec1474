// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/place_in_map.h"

#include <map>

namespace plm_vins {

void PlaceInMap::SetMap(const KeyframeMap& map) {
  loaded_.clear();
  for (const int part : map.graph.FirstConnected()) {
    const Keyframe& keyframe = map.keyframes[loaded_.size()];
    loaded_.push_back({part == 0 ? Matrix4d::Zero() : keyframe.covariance, part});
  }
  places_ = loaded_;
}

void PlaceInMap::AddKeyframe(const KeyframeMap& map) {
  const int number = newest() + 1;
  const Keyframe& keyframe = map.keyframes[number];
  if (number > 0 && map.keyframes[number - 1].world == keyframe.world) {
    places_.push_back(places_.back());
    places_.back().covariance = CovarianceOf(keyframe, Fix(map));
  } else {
    places_.push_back({keyframe.covariance, number});
    anchor_ = number;
  }
}

void PlaceInMap::AddLoop(const KeyframeMap& map, const LevelEdge& loop) {
  if (places_[loop.from].part == places_[loop.to].part) {
    Improve(map, loop);
  } else if (places_[loop.to].part == 0) {
    Join(map, Reversed(loop));
  } else {
    Join(map, loop);
    anchor_ = loop.to;
  }
}

// A loop that is less certain than odometry since the last loop does not improve the estimate.
void PlaceInMap::Improve(const KeyframeMap& map, const LevelEdge& loop) {
  const MapFix fix =
      FixBy(map, loop.to, CovarianceInMap(map.graph.node(loop.from), Covariance(loop.from), loop));
  const auto position_variance = [](const Matrix4d& covariance) {
    return covariance.topLeftCorner<3, 3>().trace();
  };
  const Matrix4d newest_covariance = CovarianceOf(map.keyframes[newest()], fix);
  if (position_variance(newest_covariance) >= position_variance(Covariance(newest()))) return;
  anchor_ = loop.to;
  places_[anchor_].covariance = fix.covariance;
  places_.back().covariance = newest_covariance;
}

// The relative uncertainty of the part's keyframes is kept, treated like that of odometry between
// keyframes.
void PlaceInMap::Join(const KeyframeMap& map, const LevelEdge& loop) {
  const PoseGraph& graph = map.graph;
  const Place end = places_[loop.to];
  const Matrix4d covariance = CovarianceInMap(graph.node(loop.from), Covariance(loop.from), loop);
  for (int i = 0; i <= newest(); ++i) {
    if (places_[i].part != end.part) continue;
    LevelEdge since;
    since.T_from_to = graph.node(loop.to).Inverse() * graph.node(i);
    since.covariance =
        StepCovariance(noise_, since.T_from_to.translation, Covariance(i) - end.covariance);
    places_[i] = {CovarianceInMap(graph.node(loop.to), covariance, since), places_[loop.from].part};
  }
  places_[loop.to].covariance = covariance;
}

// Replays all loops, each at the later one of its keyframes. Loops of removed keyframes have been
// transferred to their neighbors.
void PlaceInMap::Recompute(const KeyframeMap& map) {
  std::multimap<int, LevelEdge> loops;  // loops by the later keyframe's number
  for (const LevelEdge& edge : map.graph.edges()) {
    if (!edge.is_loop) continue;
    const LevelEdge loop = edge.from < edge.to ? edge : Reversed(edge);
    loops.emplace(loop.to, loop);
  }
  places_ = loaded_;
  while (places_.size() < map.keyframes.size()) {
    AddKeyframe(map);
    const auto [begin, end] = loops.equal_range(newest());
    for (auto loop = begin; loop != end; ++loop) AddLoop(map, loop->second);
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

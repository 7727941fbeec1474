// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/loop_closer.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/append.h"
#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/keyframes/keyframe_maker.h"
#include "pose_graph/keyframes/keyframe_policy.h"
#include "pose_graph/map/landmark_update.h"

namespace plm_vins {
namespace {

constexpr KeyframeSpacing kSpacing = {};
// Denser keyframes while the pose in the map is unknown, to find it soon.
constexpr KeyframeSpacing kLostSpacing = {0.1, 5 * M_PI / 180, 0.5};

std::vector<LoopCandidate*> NewLoops(LoopClosure* closure) {
  std::vector<LoopCandidate*> loops;
  for (LoopCandidate& loop : closure->confirmed) loops.push_back(&loop);
  for (LoopCandidate& loop : closure->candidates) {
    if (!loop.failed) loops.push_back(&loop);
  }
  return loops;
}

// Removes the loop from `edges`. Returns whether it was found.
bool Take(const LoopCandidate& loop, std::vector<LevelEdge>* edges) {
  const auto is_loop = [&loop](const LevelEdge& edge) {
    return edge.from == loop.earlier && edge.to == loop.later;
  };
  const auto found = std::find_if(edges->begin(), edges->end(), is_loop);
  if (found == edges->end()) return false;
  edges->erase(found);
  return true;
}

}  // namespace

LoopCloser::LoopCloser(const CameraModels& cameras)
    : cameras_(cameras),
      verification_(LoopVerificationOptions(cameras.front()->FocalLength()), cameras) {}

void LoopCloser::SetMap(KeyframeMap map) {
  const auto has_more = [this](const Keyframe& keyframe) {
    return keyframe.T_B_C.size() > cameras_.size();
  };
  if (std::any_of(map.keyframes.begin(), map.keyframes.end(), has_more)) {
    throw std::runtime_error(
        "the map was recorded with more cameras than num_of_cam; use the "
        "configuration of all of them");
  }
  map_ = std::move(map);
  map_.graph.HoldFrame();
  place_.SetMap(map_);
  thinning_.StartBehind(map_);
  for (size_t i = 0; i < map_.keyframes.size(); ++i) {
    recognition_.Add(map_.keyframes[i], static_cast<int>(i));
    world_ = std::max(world_, map_.keyframes[i].world + 1);
  }
}

LoopClosure LoopCloser::Add(const OdometryFrame& frame) {
  if (frame.restarted) {
    ++world_;
    path_ = 0;
    last_position_O_.reset();
  }
  if (last_position_O_) path_ += (frame.T_O_B.translation - *last_position_O_).norm();
  last_position_O_ = frame.T_O_B.translation;

  if (!IsKeyframe(frame)) {
    LoopClosure closure;
    closure.fix = Fix();
    return closure;
  }
  Keyframe keyframe = MakeKeyframe(CornerSelectionOptions(), cameras_, frame);
  keyframe.world = world_;
  keyframe.path = path_;
  return Add(std::move(keyframe));
}

LoopClosure LoopCloser::Add(Keyframe keyframe) {
  const bool continues = HasKeyframeOf(keyframe.world);
  const LevelTransform T_O_L = keyframe.T_O_L();
  const int number =
      map_.graph.AddNode(continues ? map_.T_M_O(map_.graph.size() - 1) * T_O_L : T_O_L);
  map_.keyframes.push_back(std::move(keyframe));
  UpdateLandmarks(verification_.max_error(), &map_.keyframes);
  recognition_.Add(map_.keyframes.back(), number);
  if (continues) ConnectToPrevious(number);
  place_.AddKeyframe(map_);

  LoopClosure closure;
  closure.is_keyframe = true;
  LookForLoops(&closure);
  Thin();
  closure.fix = Fix();
  return closure;
}

// The newest keyframes belong to the newest world, so checking the last one suffices.
bool LoopCloser::HasKeyframeOf(int world) const {
  return !map_.keyframes.empty() && map_.keyframes.back().world == world;
}

bool LoopCloser::IsKeyframe(const OdometryFrame& frame) const {
  if (!HasKeyframeOf(world_)) return true;
  const KeyframeSpacing& spacing = Fix() ? kSpacing : kLostSpacing;
  const Keyframe& last = map_.keyframes.back();
  return IsApart(spacing, last.t_ns, last.T_O_B, frame.t_ns, frame.T_O_B);
}

void LoopCloser::ConnectToPrevious(int number) {
  const Keyframe& from = map_.keyframes[number - 1];
  const Keyframe& to = map_.keyframes[number];
  LevelEdge edge;
  edge.from = number - 1;
  edge.to = number;
  edge.T_from_to = from.T_O_L().Inverse() * to.T_O_L();
  edge.covariance =
      StepCovariance(OdometryNoise(), edge.T_from_to.translation, to.covariance - from.covariance);
  // Extends the distance if the estimated covariance exceeds the drift over that distance, as after
  // images without features.
  edge.way = std::max(edge.T_from_to.translation.norm(),
                      kLoopDrift.DistanceOf(edge.covariance.diagonal()));
  map_.graph.AddEdge(edge);
}

void LoopCloser::LookForLoops(LoopClosure* closure) {
  for (const PlaceCandidate& place : recognition_.Find(map_.keyframes)) {
    LoopObservations observations;
    LoopCandidate candidate = Examine(place, &observations);
    if (!candidate.failed) {
      closure->confirmed = acceptance_.Judge(map_.keyframes, map_.graph, &candidate);
    }
    if (!candidate.failed) closure->place = {candidate.earlier, std::move(observations)};
    closure->candidates.push_back(candidate);
    if (!candidate.failed) break;  // another candidate would add no information
  }
  const std::vector<LoopCandidate*> loops = NewLoops(closure);
  if (loops.empty()) return;
  AddLoops(loops);
  Optimize(loops, closure);
  const bool is_reversed = Reconsider(loops, closure);
  if (is_reversed || !closure->dropped.empty()) return place_.Recompute(map_);
  for (const LoopCandidate* loop : loops) {
    if (!loop->failed) place_.AddLoop(map_, EdgeOf(*loop));
  }
}

LoopCandidate LoopCloser::Examine(const PlaceCandidate& place, LoopObservations* observations) {
  LoopCandidate candidate;
  candidate.earlier = place.earlier.keyframe;
  candidate.earlier_camera = place.earlier.camera;
  candidate.later_camera = place.camera;
  candidate.later = static_cast<int>(map_.keyframes.size()) - 1;
  candidate.earlier_ns = map_.keyframes[candidate.earlier].t_ns;
  candidate.later_ns = map_.keyframes[candidate.later].t_ns;
  candidate.score_share = place.score_share;
  candidate.repeated = place.repeated;
  if (!place.similar) {
    candidate.failed = LoopGate::kScore;
  } else if (!place.repeated) {
    candidate.failed = LoopGate::kRepeated;
  } else {
    *observations = verification_.Verify(IslandOf(place.earlier),
                                         IslandOf({candidate.later, place.camera}), &candidate);
  }
  return candidate;
}

Island LoopCloser::IslandOf(const MapImage& image) const {
  const std::vector<Keyframe>& keyframes = map_.keyframes;
  Island island;
  island.keyframe = &keyframes[image.keyframe];
  island.camera = image.camera;
  for (const int i : NumbersAround(keyframes, image.keyframe, kIslandRadius)) {
    island.all.push_back(&keyframes[i]);
  }
  return island;
}

// If a loop connects two parts, the later part is moved to satisfy the loop; the part of the first
// keyframe never moves.
void LoopCloser::AddLoops(const std::vector<LoopCandidate*>& loops) {
  for (const LoopCandidate* loop : loops) {
    const LevelEdge edge = EdgeOf(*loop);
    if (!map_.graph.AreConnected(edge.from, edge.to)) {
      const LevelEdge move = map_.graph.AreConnected(0, edge.to) ? Reversed(edge) : edge;
      const LevelTransform T_M_L = map_.graph.node(move.from) * move.T_from_to;
      map_.graph.MovePart(move.to, T_M_L * map_.graph.node(move.to).Inverse());
    }
    map_.graph.AddEdge(edge);
  }
}

void LoopCloser::Optimize(const std::vector<LoopCandidate*>& loops, LoopClosure* closure) {
  closure->dropped = map_.graph.Optimize();
  for (LoopCandidate* loop : loops) {
    loop->graph_error = map_.graph.Deviations(EdgeOf(*loop));
    if (Take(*loop, &closure->dropped)) loop->failed = LoopGate::kGraph;
  }
}

// A wrong loop that was accepted first contradicts every correct loop after it, so that the graph
// rejects them one by one. Added together, they may outvote it.
bool LoopCloser::Reconsider(const std::vector<LoopCandidate*>& loops, LoopClosure* closure) {
  const size_t rejected_before = rejected_.size();
  for (const LoopCandidate* loop : loops) {
    if (loop->failed) rejected_.push_back(*loop);
  }
  if (rejected_.size() == rejected_before) return false;
  constexpr size_t kFewestRejected = 3, kMostRejected = 8;
  if (rejected_.size() < kFewestRejected) return false;
  while (rejected_.size() > kMostRejected) rejected_.erase(rejected_.begin());

  const PoseGraph before = map_.graph;
  for (const LoopCandidate& loop : rejected_) map_.graph.AddEdge(EdgeOf(loop));
  std::vector<LevelEdge> given_up = map_.graph.Optimize();
  std::vector<LoopCandidate> right, wrong;
  for (LoopCandidate& loop : rejected_) (Take(loop, &given_up) ? wrong : right).push_back(loop);
  const bool are_more = !given_up.empty() && right.size() >= given_up.size() + 2;
  if (!are_more) {
    map_.graph = before;
    return false;
  }
  Append(given_up, &closure->dropped);
  for (LoopCandidate& loop : right) {
    loop.failed.reset();
    loop.graph_error = map_.graph.Deviations(EdgeOf(loop));
    closure->reconsidered.push_back(loop);
  }
  rejected_ = std::move(wrong);
  return true;
}

void LoopCloser::Thin() {
  while (const auto keyframe = thinning_.Next(map_)) {
    recognition_.Remove(map_.keyframes[keyframe->number], keyframe->number);
    acceptance_.Forget(keyframe->number);
    ForgetLoopsOf(keyframe->number, &rejected_);
    map_.Remove(keyframe->number, keyframe->nearest);
  }
}

std::optional<MapFix> LoopCloser::Fix() const {
  const int newest = map_.graph.size() - 1;
  if (!map_.graph.AreConnected(0, newest)) return std::nullopt;
  return place_.Fix(map_);
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/map_bundle.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "common/append.h"
#include "map_bundle/bundle_noise.h"
#include "map_bundle/bundle_problem.h"
#include "map_bundle/landmark_collection.h"

namespace plm_vins {
namespace {

size_t CountAgain(const std::vector<LandmarkTrack>& landmarks) {
  size_t count = 0;
  for (const LandmarkTrack& landmark : landmarks) {
    for (const LandmarkTrack::Observation& observation : landmark.observations) {
      count += observation.again ? 1 : 0;
    }
  }
  return count;
}

// Returns the observations that the map does not keep, with the positions of their landmarks.
std::vector<KeyframeObservation> OthersOf(const PointFrame& frame,
                                          const std::vector<MapPoint>& landmarks) {
  std::unordered_map<int64_t, Eigen::Vector3d> positions;
  for (const MapPoint& landmark : landmarks) positions.emplace(landmark.id, landmark.p_W);
  std::vector<KeyframeObservation> others;
  for (const PointObservation& point : frame.points) {
    if (point.camera == 0 && !point.depth) continue;
    KeyframeObservation& other = others.emplace_back();
    other.track = point.id;
    other.camera = point.camera;
    other.xy = point.xy;
    other.depth = point.depth;
    if (const auto p = positions.find(point.id); p != positions.end()) other.p_O = p->second;
  }
  return others;
}

}  // namespace

void MapBundle::AddKeyframe(const KeyframeMap& map, const EstimatorOutput& odometry, int64_t imu_ns,
                            const PointFrame& points) {
  ForgetRemoved(map);
  const int newest = map.graph.size() - 1;
  BundleKeyframe& keyframe = keyframes_[newest];
  keyframe.world = map.keyframes[newest].world;
  keyframe.recording = imu_.newest();
  keyframe.state = odometry.state;
  keyframe.state.t_ns = imu_ns;
  keyframe.noise = odometry.imu_noise;
  keyframe.stationary = odometry.stationary;
  keyframe.observations = OthersOf(points, odometry.points);
}

void MapBundle::ForgetRemoved(const KeyframeMap& map) {
  for (auto next = keyframes_.begin(); next != keyframes_.end();) {
    if (map.graph.Has(next->first)) {
      ++next;
      continue;
    }
    ForgetObservationsBy(next->first);
    next = keyframes_.erase(next);
    if (next == keyframes_.begin() || next == keyframes_.end()) continue;
    const BundleKeyframe &from = std::prev(next)->second, &to = next->second;
    if (from.recording == to.recording && !HasMotionBetween(from, to)) {
      imu_.Forget(from.recording, from.state.t_ns, to.state.t_ns);
    }
  }
}

// The observations of a place are by its two keyframes, so places of earlier visits have none.
void MapBundle::ForgetObservationsBy(int keyframe) {
  const auto is_by_it = [&](const Reobservation& again) {
    return again.observation.keyframe == keyframe;
  };
  for (auto place = places_.lower_bound({keyframe, 0}); place != places_.end(); ++place) {
    std::vector<Reobservation>& observations = place->second.observations;
    observations.erase(std::remove_if(observations.begin(), observations.end(), is_by_it),
                       observations.end());
    observations.shrink_to_fit();
  }
}

void MapBundle::AddLoops(const KeyframeMap& map, const LoopClosure& closure) {
  if (closure.place) AddPlace(map, *closure.place, !closure.candidates.back().failed);
  for (const LoopCandidate& loop : closure.reconsidered) SetCounts(loop.earlier, loop.later, true);
  for (const LevelEdge& edge : closure.dropped) SetCounts(edge.from, edge.to, false);
}

void MapBundle::AddPlace(const KeyframeMap& map, const RecognizedPlace& place, bool counts) {
  const int newest = map.graph.size() - 1;
  Place& added = places_[{newest, place.earlier}];
  added.counts = counts;
  const auto add = [&](const std::vector<SeenPoint>& seen, int of, const MapImage& by) {
    for (const SeenPoint& point : seen) {
      LandmarkTrack::Observation observation;
      observation.keyframe = by.keyframe;
      observation.camera = by.camera;
      observation.xy = point.xy;
      observation.again = true;
      added.observations.push_back({{map.keyframes[of].world, point.track}, observation});
    }
  };
  const LoopObservations& seen = place.observations;
  add(seen.of_earlier, place.earlier, {newest, seen.later_camera});
  add(seen.of_later, newest, {place.earlier, seen.earlier_camera});
}

void MapBundle::SetCounts(int a, int b, bool counts) {
  const auto place = places_.find({std::max(a, b), std::min(a, b)});
  if (place != places_.end()) place->second.counts = counts;
}

size_t MapBundle::CountPlaces() const {
  return static_cast<size_t>(std::count_if(places_.begin(), places_.end(),
                                           [](const auto& place) { return place.second.counts; }));
}

std::vector<Reobservation> MapBundle::Observations() const {
  std::vector<Reobservation> observations;
  for (const auto& [keyframes, place] : places_) {
    if (place.counts) Append(place.observations, &observations);
  }
  return observations;
}

BundleState MapBundle::StateOf(const KeyframeMap& map) const {
  const std::vector<int> numbers = map.NumbersInMap();
  BundleState bundle;
  bundle.T_B_C = map.keyframes.back().T_B_C;
  for (const int number : numbers) {
    BundleKeyframe& member = bundle.keyframes[number];
    const auto of_this_run = keyframes_.find(number);
    if (of_this_run == keyframes_.end()) {  // keyframe of the loaded map: its camera pose is fixed
      member.state.SetPose(map.T_M_C({number, 0}) * bundle.T_B_C.front().Inverse());
      continue;
    }
    member = of_this_run->second;
    const LevelTransform T_M_O = map.T_M_O(number);
    member.state.SetPose(T_M_O.ToRigid() * map.keyframes[number].T_O_B);
    member.state.velocity() = T_M_O.rotation() * Eigen::Vector3d(member.state.velocity());
    member.start = member.state;
  }
  bundle.landmarks = CollectLandmarks(map, bundle, Observations());
  return bundle;
}

size_t MapBundle::KeyframesToAdjust(const KeyframeMap& map) const {
  if (CountPlaces() < options_.min_places) return 0;
  const size_t keyframes = map.NumbersInMap().size();
  return keyframes < options_.min_keyframes ? 0 : keyframes;
}

// Estimates the observation noise of each round from the residuals of the previous round.
void MapBundle::AdjustInRounds(const std::function<bool()>& is_end, BundleState* bundle) {
  const double noise = options_.point_noise;
  const ObservationNoise configured = {noise, noise, noise};
  BundleOptions options;
  options.gravity_norm = options_.gravity_norm;
  options.noise = configured;
  options.depth_noise = options_.depth_noise;
  constexpr int kRounds = 3;
  while (summary_.rounds < kRounds) {
    summary_.ended = is_end();
    if (summary_.ended) break;
    summary_.failed = !AdjustBundle(imu_, options, bundle);
    if (summary_.failed) break;
    ++summary_.rounds;
    options.noise = EstimateNoise(*bundle, configured);
  }
  summary_.noise = options.noise;
}

std::optional<AdjustedMap> MapBundle::Adjust(const KeyframeMap& map,
                                             const std::function<bool()>& is_end) {
  summary_ = MapBundleSummary();
  if (KeyframesToAdjust(map) == 0) return std::nullopt;
  BundleState bundle = StateOf(map);
  summary_.keyframes = bundle.keyframes.size();
  summary_.landmarks = bundle.landmarks.size();
  summary_.reobservations = CountAgain(bundle.landmarks);
  AdjustInRounds(is_end, &bundle);
  if (summary_.rounds == 0) return std::nullopt;

  AdjustedMap adjusted;
  adjusted.T_B_C = bundle.T_B_C;
  for (const auto& [number, keyframe] : bundle.keyframes) {
    if (keyframe.moves()) adjusted.T_M_B[number] = keyframe.state.T_W_B();
  }
  for (const LandmarkTrack& landmark : bundle.landmarks) adjusted.p_M[landmark.key] = landmark.p_M;
  return adjusted;
}

}  // namespace plm_vins

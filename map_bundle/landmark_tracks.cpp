// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/landmark_tracks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {
namespace {

const double kMaxCosine = std::cos(M_PI / 180);  // cosine of the smallest parallax angle

struct Observations {
  std::optional<Eigen::Vector3d> p_M;  // from the newest keyframe that triangulated the landmark
  std::vector<LandmarkObservation> all;

  // Adds an observation, unless its keyframe already has one.
  void Add(const LandmarkObservation& observation) {
    const auto is_of_same = [&](const LandmarkObservation& other) {
      return other.keyframe == observation.keyframe;
    };
    if (std::none_of(all.begin(), all.end(), is_of_same)) all.push_back(observation);
  }
};

// Returns whether a ray has enough parallax to the first one. Otherwise the depth is unobservable,
// and a solver step may move the landmark beyond infinity, which Ceres treats as a failed step.
bool IsSeenFromTwoSides(const KeyframeMap& map,
                        const std::vector<LandmarkObservation>& observations) {
  const auto ray_M = [&](const LandmarkObservation& observation) -> Eigen::Vector3d {
    return map.T_M_C(observation.keyframe).rotation * observation.xy.homogeneous().normalized();
  };
  const Eigen::Vector3d first = ray_M(observations.front());
  return std::any_of(observations.begin(), observations.end(),
                     [&](const LandmarkObservation& observation) {
                       return ray_M(observation).dot(first) < kMaxCosine;
                     });
}

bool IsBeforeAllCameras(const KeyframeMap& map, const Eigen::Vector3d& p_M,
                        const std::vector<LandmarkObservation>& observations) {
  return std::all_of(
      observations.begin(), observations.end(), [&](const LandmarkObservation& observation) {
        return (map.T_M_C(observation.keyframe).Inverse() * p_M).z() >= kMinTriangulatedDepth;
      });
}

}  // namespace

std::vector<LandmarkTrack> CollectLandmarks(const KeyframeMap& map,
                                            const std::vector<int>& keyframes,
                                            const std::vector<Reobservation>& again) {
  std::map<LandmarkKey, Observations> by_key;
  for (const int number : keyframes) {
    const Keyframe& keyframe = map.keyframes[number];
    for (const DescribedCorner& corner : keyframe.corners) {
      if (corner.track < 0) continue;
      Observations& observations = by_key[{keyframe.world, corner.track}];
      if (corner.p_O) observations.p_M = map.T_M_O(number) * corner.p_O->cast<double>();
      observations.Add({number, corner.xy.cast<double>(), /*again=*/false});
    }
  }
  for (const Reobservation& observation : again) {
    const auto seen = by_key.find(observation.landmark);
    if (seen == by_key.end()) continue;
    if (!std::binary_search(keyframes.begin(), keyframes.end(), observation.keyframe)) continue;
    seen->second.Add({observation.keyframe, observation.xy, /*again=*/true});
  }
  std::vector<LandmarkTrack> tracks;
  for (auto& [key, seen] : by_key) {
    if (!seen.p_M || !IsSeenFromTwoSides(map, seen.all)) continue;
    if (!IsBeforeAllCameras(map, *seen.p_M, seen.all)) continue;
    tracks.push_back({key, *seen.p_M, std::move(seen.all)});
  }
  return tracks;
}

}  // namespace plm_vins

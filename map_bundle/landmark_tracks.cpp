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

struct Sightings {
  std::optional<Eigen::Vector3d> p_M;  // from the newest keyframe that triangulated the landmark
  std::vector<LandmarkSighting> all;

  // Adds an observation, unless its keyframe already has one.
  void Add(const LandmarkSighting& sighting) {
    const auto is_of_same = [&](const LandmarkSighting& other) {
      return other.keyframe == sighting.keyframe;
    };
    if (std::none_of(all.begin(), all.end(), is_of_same)) all.push_back(sighting);
  }
};

// Returns whether a ray has enough parallax to the first one. Otherwise the depth is unobservable,
// and a solver step may move the landmark beyond infinity, which Ceres treats as a failed step.
bool IsSeenFromTwoSides(const KeyframeMap& map, const std::vector<LandmarkSighting>& sightings) {
  const auto ray_M = [&](const LandmarkSighting& sighting) -> Eigen::Vector3d {
    return map.T_M_C(sighting.keyframe).rotation * sighting.xy.homogeneous().normalized();
  };
  const Eigen::Vector3d first = ray_M(sightings.front());
  return std::any_of(sightings.begin(), sightings.end(), [&](const LandmarkSighting& sighting) {
    return ray_M(sighting).dot(first) < kMaxCosine;
  });
}

bool IsBeforeAllCameras(const KeyframeMap& map, const Eigen::Vector3d& p_M,
                        const std::vector<LandmarkSighting>& sightings) {
  return std::all_of(sightings.begin(), sightings.end(), [&](const LandmarkSighting& sighting) {
    return (map.T_M_C(sighting.keyframe).Inverse() * p_M).z() >= kMinTriangulatedDepth;
  });
}

}  // namespace

std::vector<LandmarkTrack> CollectLandmarks(const KeyframeMap& map,
                                            const std::vector<int>& keyframes,
                                            const std::vector<SightingAgain>& again) {
  std::map<LandmarkKey, Sightings> by_key;
  for (const int number : keyframes) {
    const Keyframe& keyframe = map.keyframes[number];
    for (const DescribedCorner& corner : keyframe.corners) {
      if (corner.track < 0) continue;
      Sightings& sightings = by_key[{keyframe.world, corner.track}];
      if (corner.p_O) sightings.p_M = map.T_M_O(number) * corner.p_O->cast<double>();
      sightings.Add({number, corner.xy.cast<double>(), /*again=*/false});
    }
  }
  for (const SightingAgain& sighting : again) {
    const auto seen = by_key.find(sighting.landmark);
    if (seen == by_key.end()) continue;
    if (!std::binary_search(keyframes.begin(), keyframes.end(), sighting.keyframe)) continue;
    seen->second.Add({sighting.keyframe, sighting.xy, /*again=*/true});
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

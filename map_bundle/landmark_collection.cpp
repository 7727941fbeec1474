// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/landmark_collection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {
namespace {

using Observation = LandmarkTrack::Observation;

const double kMaxCosine = std::cos(M_PI / 180);  // cosine of the smallest parallax angle

struct Observations {
  std::optional<Eigen::Vector3d> p_M;  // from the newest keyframe that triangulated the landmark
  std::vector<Observation> all;

  // Adds an observation. If its image already has one, only a measured depth is added to that.
  void Add(const Observation& observation) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const Observation& other) {
      return other.keyframe == observation.keyframe && other.camera == observation.camera;
    });
    if (same == all.end()) {
      all.push_back(observation);
    } else if (observation.depth) {
      same->depth = observation.depth;
    }
  }
};

using ObservationsByKey = std::map<LandmarkKey, Observations>;

// Adds what the map keeps.
void AddCorners(const KeyframeMap& map, int number, ObservationsByKey* by_key) {
  const Keyframe& keyframe = map.keyframes[number];
  for (const DescribedCorner& corner : keyframe.corners) {
    if (corner.track < 0) continue;
    Observations& observations = (*by_key)[{keyframe.world, corner.track}];
    if (corner.p_O) observations.p_M = map.T_M_O(number) * corner.p_O->cast<double>();
    observations.Add({number, corner.camera, corner.xy.cast<double>()});
  }
}

// Adds the observations of other cameras and the measured depths.
void AddOthers(const KeyframeMap& map, int number, const BundleKeyframe& keyframe,
               ObservationsByKey* by_key) {
  for (const KeyframeObservation& seen : keyframe.observations) {
    Observations& observations = (*by_key)[{keyframe.world, seen.track}];
    if (seen.p_O) observations.p_M = map.T_M_O(number) * *seen.p_O;
    observations.Add({number, seen.camera, seen.xy, seen.depth});
  }
}

// Returns whether a ray has enough parallax to the first one. Otherwise the depth is unobservable,
// and a solver step may move the landmark beyond infinity, which Ceres treats as a failed step.
bool IsSeenFromTwoSides(const BundleState& bundle, const std::vector<Observation>& observations) {
  const auto ray_M = [&](const Observation& o) -> Eigen::Vector3d {
    return bundle.T_M_C(o.keyframe, o.camera).rotation * o.xy.homogeneous().normalized();
  };
  const Eigen::Vector3d first = ray_M(observations.front());
  return std::any_of(observations.begin(), observations.end(), [&](const Observation& o) {
    return o.depth || ray_M(o).dot(first) < kMaxCosine;
  });
}

bool IsBeforeAllCameras(const BundleState& bundle, const Eigen::Vector3d& p_M,
                        const std::vector<Observation>& observations) {
  return std::all_of(observations.begin(), observations.end(), [&](const Observation& o) {
    const Eigen::Vector3d p_C = bundle.T_M_C(o.keyframe, o.camera).Inverse() * p_M;
    return p_C.z() >= kMinTriangulatedDepth;
  });
}

}  // namespace

std::vector<LandmarkTrack> CollectLandmarks(const KeyframeMap& map, const BundleState& bundle,
                                            const std::vector<Reobservation>& again) {
  ObservationsByKey by_key;
  for (const auto& [number, keyframe] : bundle.keyframes) {
    AddCorners(map, number, &by_key);
    AddOthers(map, number, keyframe, &by_key);
  }
  for (const Reobservation& observation : again) {
    const auto seen = by_key.find(observation.landmark);
    if (seen == by_key.end()) continue;
    if (bundle.keyframes.count(observation.observation.keyframe) == 0) continue;
    seen->second.Add(observation.observation);
  }
  std::vector<LandmarkTrack> tracks;
  for (auto& [key, seen] : by_key) {
    if (!seen.p_M || !IsSeenFromTwoSides(bundle, seen.all)) continue;
    if (!IsBeforeAllCameras(bundle, *seen.p_M, seen.all)) continue;
    tracks.push_back({key, *seen.p_M, std::move(seen.all)});
  }
  return tracks;
}

}  // namespace plm_vins

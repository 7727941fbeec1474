// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/placed_features.h"

#include <unordered_map>
#include <unordered_set>

namespace plm_vins {

std::vector<TrackedCorner> PlaceCorners(const PointFrame& frame,
                                        const std::vector<MapPoint>& landmarks) {
  std::unordered_map<int64_t, Eigen::Vector3d> places;
  for (const MapPoint& landmark : landmarks) places.emplace(landmark.id, landmark.p_W);
  std::vector<TrackedCorner> corners;
  std::unordered_set<int64_t> ids;
  for (const PointObservation& observation : frame.points) {
    if (!ids.insert(observation.id).second) continue;
    TrackedCorner& corner = corners.emplace_back();
    corner.observation = observation;
    const auto place = places.find(observation.id);
    if (place != places.end()) corner.p_O = place->second;
  }
  return corners;
}

std::vector<TrackedSegment> PlaceSegments(const LineFrame& frame,
                                          const std::vector<MapLine>& landmarks) {
  std::unordered_map<int64_t, SpaceSegment> places;
  for (const MapLine& landmark : landmarks) {
    places.emplace(landmark.id, SpaceSegment{landmark.start_W, landmark.end_W});
  }
  std::vector<TrackedSegment> segments;
  std::unordered_set<int64_t> ids;
  for (const LineObservation& observation : frame.lines) {
    if (!ids.insert(observation.id).second) continue;
    TrackedSegment& segment = segments.emplace_back();
    segment.observation = observation;
    const auto place = places.find(observation.id);
    if (place != places.end()) segment.landmark = place->second;
  }
  return segments;
}

}  // namespace plm_vins

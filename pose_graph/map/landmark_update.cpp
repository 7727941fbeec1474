// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/landmark_update.h"

#include <unordered_map>
#include <vector>

#include "pose_graph/verification/loop_observations.h"

namespace plm_vins {
namespace {

using PlacesByTrack = std::unordered_map<int64_t, Eigen::Vector3f>;

PlacesByTrack PlacesOf(const Keyframe& keyframe) {
  PlacesByTrack places;
  for (const DescribedCorner& corner : keyframe.corners) {
    if (corner.track >= 0 && corner.p_O) places.emplace(corner.track, *corner.p_O);
  }
  return places;
}

// Sets the landmarks of `keyframe` that have a known position. Returns whether it shares any track
// with `places`.
bool TakeOver(const PlacesByTrack& places, double max_error, Keyframe* keyframe) {
  std::vector<Viewpoint> viewpoints;
  for (int camera = 0; camera < keyframe->cameras(); ++camera) {
    const Rigid3d T_O_C = keyframe->T_O_C(camera);
    viewpoints.emplace_back(LevelTransform{0, T_O_C.translation}, T_O_C.rotation);
  }
  bool shares_tracks = false;
  for (DescribedCorner& corner : keyframe->corners) {
    const auto place = places.find(corner.track);
    if (place == places.end()) continue;
    shares_tracks = true;
    const SeenPoint seen = {place->second.cast<double>(), corner.xy.cast<double>()};
    if (viewpoints[corner.camera].Error(seen) < max_error) corner.p_O = place->second;
  }
  return shares_tracks;
}

}  // namespace

void UpdateLandmarks(double max_error, std::vector<Keyframe>* keyframes) {
  if (keyframes->empty()) return;
  const Keyframe& newest = keyframes->back();
  const PlacesByTrack places = PlacesOf(newest);
  for (auto earlier = keyframes->rbegin() + 1; earlier != keyframes->rend(); ++earlier) {
    if (earlier->world != newest.world) return;
    if (earlier->corners.empty()) continue;  // it was removed from the map
    if (!TakeOver(places, max_error, &*earlier)) return;
  }
}

}  // namespace plm_vins

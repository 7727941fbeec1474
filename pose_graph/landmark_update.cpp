// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/landmark_update.h"

#include <unordered_map>

namespace plm_vins {
namespace {

constexpr double kMaxError = 4.0 / 460;  // normalised

using PlacesByTrack = std::unordered_map<int64_t, Eigen::Vector3f>;

PlacesByTrack PlacesOf(const Keyframe& keyframe) {
  PlacesByTrack places;
  for (const DescribedCorner& corner : keyframe.corners) {
    if (corner.track >= 0 && corner.p_O) places.emplace(corner.track, *corner.p_O);
  }
  return places;
}

bool IsSeenAt(const Rigid3d& T_C_O, const Eigen::Vector3f& p_O, const Eigen::Vector2f& xy) {
  const Eigen::Vector3d p_C = T_C_O * p_O.cast<double>();
  return p_C.z() > 0 && (p_C.hnormalized() - xy.cast<double>()).norm() < kMaxError;
}

// Whether any track is one of those whose places are known.
bool TakeOver(const PlacesByTrack& places, Keyframe* keyframe) {
  const Rigid3d T_C_O = keyframe->T_O_C().Inverse();
  bool shares_tracks = false;
  for (DescribedCorner& corner : keyframe->corners) {
    const auto place = places.find(corner.track);
    if (place == places.end()) continue;
    shares_tracks = true;
    if (IsSeenAt(T_C_O, place->second, corner.xy)) corner.p_O = place->second;
  }
  return shares_tracks;
}

}  // namespace

void UpdateLandmarks(std::vector<Keyframe>* keyframes) {
  if (keyframes->empty()) return;
  const Keyframe& newest = keyframes->back();
  const PlacesByTrack places = PlacesOf(newest);
  for (auto earlier = keyframes->rbegin() + 1; earlier != keyframes->rend(); ++earlier) {
    if (earlier->world != newest.world || !TakeOver(places, &*earlier)) return;
  }
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/tracks.h"

#include <algorithm>
#include <map>

namespace plm_vins {

std::vector<Track> CollectTracks(const std::vector<const PointFrame*>& views) {
  std::map<int64_t, Track> by_id;
  for (size_t view = 0; view < views.size(); ++view) {
    for (const PointObservation& point : views[view]->points) {
      Track& track = by_id[point.id];
      track.id = point.id;
      track.observations.push_back({static_cast<int>(view), point.xy});
    }
  }
  std::vector<Track> tracks;
  for (auto& [id, track] : by_id) {
    if (track.observations.size() >= 2) tracks.push_back(std::move(track));
  }
  return tracks;
}

std::vector<Correspondence> FindCorrespondences(const std::vector<Track>& tracks, int view0,
                                                int view1) {
  std::vector<Correspondence> correspondences;
  for (const Track& track : tracks) {
    const auto& seen = track.observations;
    const auto find = [&seen](int view) {
      return std::find_if(seen.begin(), seen.end(),
                          [view](const ViewObservation& o) { return o.view == view; });
    };
    const auto first = find(view0), second = find(view1);
    if (first == seen.end() || second == seen.end()) continue;
    correspondences.push_back({first->xy, second->xy});
  }
  return correspondences;
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/tracks.h"

#include <algorithm>
#include <map>

namespace plm_vins {

const ViewObservation* Track::In(int view) const {
  const auto found = std::find_if(observations.begin(), observations.end(),
                                  [view](const ViewObservation& o) { return o.view == view; });
  return found == observations.end() ? nullptr : &*found;
}

std::vector<Track> CollectTracks(const std::vector<const PointFrame*>& views) {
  std::map<int64_t, Track> by_id;
  for (size_t view = 0; view < views.size(); ++view) {
    for (const PointObservation& point : views[view]->points) {
      Track& track = by_id[point.id];
      track.id = point.id;
      track.observations.push_back({static_cast<int>(view), point.xy, point.right, point.depth});
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
    const ViewObservation* const first = track.In(view0);
    const ViewObservation* const second = track.In(view1);
    if (first == nullptr || second == nullptr) continue;
    correspondences.push_back({first->xy, second->xy});
  }
  return correspondences;
}

}  // namespace plm_vins

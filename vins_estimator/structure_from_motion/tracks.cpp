// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/tracks.h"

#include <algorithm>
#include <map>
#include <utility>

namespace plm_vins {
namespace {

bool IsInSeveralViews(const Track& track) {
  return !track.observations.empty() &&
         track.observations.front().view != track.observations.back().view;
}

}  // namespace

const Track::Observation* Track::In(int view) const {
  const auto found = std::find_if(observations.begin(), observations.end(),
                                  [view](const Observation& o) { return o.view == view; });
  return found == observations.end() ? nullptr : &*found;
}

std::vector<Track> CollectTracks(const std::vector<const PointFrame*>& views) {
  std::map<int64_t, Track> by_id;
  for (size_t i = 0; i < views.size(); ++i) {
    const int view = static_cast<int>(i);
    for (const PointObservation& point : views[i]->points) {
      Track& track = by_id[point.id];
      track.id = point.id;
      track.observations.push_back({view, point.camera, point.xy, point.depth});
    }
  }
  std::vector<Track> tracks;
  for (auto& [id, track] : by_id) {
    if (IsInSeveralViews(track)) tracks.push_back(std::move(track));
  }
  return tracks;
}

std::vector<Track> OfCamera(int camera, const std::vector<Track>& tracks) {
  std::vector<Track> result;
  for (const Track& track : tracks) {
    Track own{track.id, {}};
    for (const Track::Observation& o : track.observations) {
      if (o.camera == camera) own.observations.push_back({o.view, o.camera, o.xy});
    }
    if (IsInSeveralViews(own)) result.push_back(std::move(own));
  }
  return result;
}

std::vector<Correspondence> FindCorrespondences(const std::vector<Track>& tracks, int view0,
                                                int view1) {
  std::vector<Correspondence> correspondences;
  for (const Track& track : tracks) {
    const Track::Observation* const first = track.In(view0);
    const Track::Observation* const second = track.In(view1);
    if (first == nullptr || second == nullptr) continue;
    correspondences.push_back({first->xy, second->xy});
  }
  return correspondences;
}

}  // namespace plm_vins

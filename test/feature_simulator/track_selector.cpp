// SPDX-License-Identifier: BSD-3-Clause
#include "test/feature_simulator/track_selector.h"

#include <set>

namespace plm_vins::simulator {

std::vector<TrackSelector::Track> TrackSelector::Update(const std::vector<int>& visible) {
  Keep(visible);
  Refill(visible);
  return tracks_;
}

void TrackSelector::Keep(const std::vector<int>& visible) {
  const std::set<int> in_view(visible.begin(), visible.end());
  std::vector<Track> kept;
  for (const Track& track : tracks_) {
    const bool breaks = random_.Uniform() < break_probability_;
    if (!breaks && in_view.count(track.landmark) > 0) kept.push_back(track);
  }
  tracks_ = std::move(kept);
}

void TrackSelector::Refill(const std::vector<int>& visible) {
  std::set<int> tracked;
  for (const Track& track : tracks_) tracked.insert(track.landmark);
  for (int landmark : visible) {
    if (static_cast<int>(tracks_.size()) >= max_tracks_) return;
    if (!tracked.insert(landmark).second) continue;
    landmark_of_id_[next_id_] = landmark;
    tracks_.push_back({next_id_++, landmark});
  }
}

}  // namespace plm_vins::simulator

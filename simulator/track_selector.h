// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "simulator/random.h"

namespace plm_vins::simulator {

// Plays the tracker's bookkeeping: landmarks stay tracked while in view, free places are given to
// new ones, a landmark that was out of view or whose track broke comes back under a new id.
class TrackSelector {
 public:
  struct Track {
    int64_t id;
    int landmark;
  };

  TrackSelector(int max_tracks, double break_probability, uint64_t seed)
      : max_tracks_(max_tracks), break_probability_(break_probability), random_(seed) {}

  // Tracks of the next image, given the landmarks in view; oldest tracks first.
  std::vector<Track> Update(const std::vector<int>& visible);

  // The landmark behind each id handed out so far.
  const std::map<int64_t, int>& landmark_of_id() const { return landmark_of_id_; }

 private:
  void Keep(const std::vector<int>& visible);
  void Refill(const std::vector<int>& visible);

  int max_tracks_;
  double break_probability_;
  Random random_;
  int64_t next_id_ = 0;
  std::vector<Track> tracks_;
  std::map<int64_t, int> landmark_of_id_;
};

}  // namespace plm_vins::simulator

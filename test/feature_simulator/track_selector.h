// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "simulator/random.h"

namespace plm_vins::simulator {

// Simulates the id assignment of a tracker: landmarks stay tracked while visible and free places
// are assigned to new ones. A landmark that was invisible, or whose track broke, gets a new id.
class TrackSelector {
 public:
  struct Track {
    int64_t id;
    int landmark;
  };

  TrackSelector(int max_tracks, double break_probability, uint64_t seed)
      : max_tracks_(max_tracks), break_probability_(break_probability), random_(seed) {}

  // Returns the tracks of the next image, given the visible landmarks; oldest tracks first.
  std::vector<Track> Update(const std::vector<int>& visible);

  // Landmark of each id assigned so far.
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

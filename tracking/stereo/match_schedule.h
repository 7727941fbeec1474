// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "common/config/config.h"
#include "common/config/stereo_pairs.h"

namespace plm_vins {

// Selects the images that are needed. The second camera of a pair is searched at most once in 80
// ms, so ten times per second at 20 Hz: keyframes are hardly more frequent, and more observations
// per keyframe cost as much time as tracking and add little. All images of the other cameras are
// needed. Depends on timestamps only, so that an image can be skipped before it is decoded.
class MatchSchedule {
 public:
  // With a rate `freq`, the trackers select images themselves, and all are needed.
  explicit MatchSchedule(const Config& config) {
    if (config.publish_rate > 0) return;
    for (const StereoPair& pair : StereoPairs(config.sensor)) last_ns_[pair.second].reset();
  }

  // Must be called once per image of a camera, in order of arrival.
  bool IsDue(int camera, int64_t t_ns) {
    const auto last = last_ns_.find(camera);
    if (last == last_ns_.end()) return true;
    std::optional<int64_t>& last_ns = last->second;
    const bool is_due = !last_ns || t_ns < *last_ns || t_ns - *last_ns >= kMinInterval_ns;
    if (is_due) last_ns = t_ns;
    return is_due;
  }

 private:
  static constexpr int64_t kMinInterval_ns = 80'000'000;

  std::map<int, std::optional<int64_t>> last_ns_;  // by second camera: its last image that was due
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace plm_vins {

// Selects the images of the second camera that are searched for features: at most one in 80 ms, so
// ten per second of a camera with 20 Hz. Keyframes are hardly more frequent, and more observations
// per keyframe cost as much time as tracking and add little. Depends on timestamps only, so that an
// image can be skipped before it is decoded.
class MatchSchedule {
 public:
  // `publish_rate` [Hz]: if positive, the trackers select images themselves, and all are due.
  explicit MatchSchedule(double publish_rate) : all_(publish_rate > 0) {}

  // Must be called once per image of the second camera, in order of arrival.
  bool IsDue(int64_t t_ns) {
    const bool is_due =
        all_ || !last_ns_ || t_ns < *last_ns_ || t_ns - *last_ns_ >= kMinInterval_ns;
    if (is_due) last_ns_ = t_ns;
    return is_due;
  }

 private:
  static constexpr int64_t kMinInterval_ns = 80'000'000;

  bool all_;
  std::optional<int64_t> last_ns_;  // timestamp of the last image that was due
};

}  // namespace plm_vins

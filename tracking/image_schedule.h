// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

namespace plm_vins {

// Selects the images that are needed: all of camera 0, and at most one in 80 ms of any other
// camera, so ten per second at 20 Hz. Keyframes are hardly more frequent, and more observations per
// keyframe cost as much time as tracking and add little. Depends on timestamps only, so that an
// image can be skipped before it is decoded.
class ImageSchedule {
 public:
  // `publish_rate` [Hz]: if positive, the trackers select images themselves, and all are needed.
  explicit ImageSchedule(double publish_rate) : all_(publish_rate > 0) {}

  // Must be called once per image of a camera, in order of arrival.
  bool IsNeeded(int camera, int64_t t_ns) {
    if (all_ || camera == 0) return true;
    const auto [last, is_first] = last_ns_.emplace(camera, t_ns);
    const int64_t interval_ns = t_ns - last->second;
    const bool is_needed = is_first || interval_ns < 0 || interval_ns >= kMinInterval_ns;
    if (is_needed) last->second = t_ns;
    return is_needed;
  }

 private:
  static constexpr int64_t kMinInterval_ns = 80'000'000;

  bool all_;
  std::map<int, int64_t> last_ns_;  // by camera: timestamp of its last image that was needed
};

}  // namespace plm_vins

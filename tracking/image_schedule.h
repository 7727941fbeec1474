// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// Reduces a stream of images to a mean rate, by timestamps only.
//
// It selects the same images as the trackers of VINS-Mono and PL-VINS, so that their features and
// ours can be paired. The first image, and the first after a gap or backward jump, is not selected
// but starts the count. A later image is selected if the mean rate since then, rounded to a whole
// number, does not exceed `rate`; once the mean rate agrees within 1 %, the count restarts at this
// image.
class RateLimiter {
 public:
  // `rate` [Hz]; a rate of at most zero selects all images.
  explicit RateLimiter(double rate) : rate_(rate) {}

  // Returns whether to use the image of this time.
  bool Take(int64_t t_ns) {
    if (rate_ <= 0) return true;
    const bool continues = last_ns_ && t_ns > *last_ns_ && t_ns - *last_ns_ <= kGap_ns;
    last_ns_ = t_ns;
    if (!continues) {
      Begin(t_ns);
      ++count_;
      return false;
    }
    const double rate_so_far = count_ / ToSeconds(t_ns - begin_ns_);
    if (std::round(rate_so_far) > rate_) return false;
    if (std::abs(rate_so_far - rate_) < kTolerance * rate_) Begin(t_ns);
    ++count_;
    return true;
  }

  void Reset() { last_ns_.reset(); }

 private:
  static constexpr int64_t kGap_ns = 1'000'000'000;
  static constexpr double kTolerance = 0.01;

  void Begin(int64_t t_ns) {
    begin_ns_ = t_ns;
    count_ = 0;
  }

  double rate_;
  std::optional<int64_t> last_ns_;
  int64_t begin_ns_ = 0;  // start of the count
  double count_ = 0;
};

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

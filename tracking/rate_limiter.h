// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
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

}  // namespace plm_vins

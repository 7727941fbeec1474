// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// Thins a stream of images to a mean rate, by the stamps alone.
//
// It takes the same images as the trackers of VINS-Mono and PL-VINS, so that features of theirs and
// ours can be paired: of the first image, and the first after a gap or a jump back, only the stamp
// is used; a later one is taken where the count since then (of which that first one is one) is not
// above the rate, to the nearest whole number; once it is the rate within 1 %, the count begins
// anew at this image.
class RateLimiter {
 public:
  // `rate` [Hz]; zero or less lets everything through.
  explicit RateLimiter(double rate) : rate_(rate) {}

  // True where the image of this time is to be used.
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
  int64_t begin_ns_ = 0;  // since when it is counted
  double count_ = 0;
};

}  // namespace plm_vins

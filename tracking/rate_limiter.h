// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace plm_vins {

// Thins a stream of increasing stamps to a mean rate, by the stamps alone.
//
// The rhythm begins with the first item of a period of absolute time, not with the first item seen:
// two limiters that begin at different items of one regular stream come to choose the same ones.
class RateLimiter {
 public:
  // `rate` [Hz]; zero or less lets everything through.
  explicit RateLimiter(double rate)
      : period_ns_(rate > 0 ? static_cast<int64_t>(std::llround(1e9 / rate)) : 0),
        tolerance_ns_(period_ns_ / 10) {}

  // True where the item of this time is to be used.
  bool Take(int64_t t_ns) {
    if (period_ns_ == 0) return true;
    const bool has_begun = rhythm_ != Rhythm::kNone;
    if (has_begun && t_ns < due_ns_ - tolerance_ns_) return false;
    const bool on_schedule = has_begun && t_ns < due_ns_ + period_ns_;
    if (!on_schedule) {
      due_ns_ = NextPeriod(t_ns);
    } else {
      due_ns_ = (rhythm_ == Rhythm::kOfStream ? due_ns_ : t_ns) + period_ns_;
    }
    rhythm_ = on_schedule ? Rhythm::kOfStream : Rhythm::kOfPeriods;
    return true;
  }

  void Reset() { rhythm_ = Rhythm::kNone; }

 private:
  enum class Rhythm { kNone, kOfPeriods, kOfStream };

  int64_t NextPeriod(int64_t t_ns) const {
    return ((t_ns + tolerance_ns_) / period_ns_ + 1) * period_ns_;
  }

  int64_t period_ns_;
  int64_t tolerance_ns_;  // of jittery stamps that come too early
  Rhythm rhythm_ = Rhythm::kNone;
  int64_t due_ns_ = 0;  // when the next item is wanted
};

}  // namespace plm_vins

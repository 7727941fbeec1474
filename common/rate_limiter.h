// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace plm_vins {

// Thins a stream of increasing stamps to a mean rate, by the stamps alone.
class RateLimiter {
 public:
  // `rate` [Hz]; zero or less lets everything through.
  explicit RateLimiter(double rate)
      : period_ns_(rate > 0 ? static_cast<int64_t>(std::llround(1e9 / rate)) : 0) {}

  // True where the item of this time is to be used.
  bool Take(int64_t t_ns) {
    if (period_ns_ == 0) return true;
    if (due_ns_ && t_ns < *due_ns_ - period_ns_ / 10) return false;  // tolerates jittery stamps
    const bool on_schedule = due_ns_ && t_ns < *due_ns_ + period_ns_;
    due_ns_ = (on_schedule ? *due_ns_ : t_ns) + period_ns_;
    return true;
  }

  void Reset() { due_ns_.reset(); }

 private:
  int64_t period_ns_;
  std::optional<int64_t> due_ns_;  // when the next item is wanted
};

}  // namespace plm_vins

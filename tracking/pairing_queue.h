// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "common/measurements.h"
#include "common/streams/stamp_order.h"

namespace plm_vins {

// Images of a further camera or of depth that wait for the image of camera 0 with the same
// timestamp. `Sample` has t_ns. Synchronous; the result depends only on the order of the calls.
template <typename Sample>
class PairingQueue {
 public:
  // Timestamps that differ by at most `tolerance` [s] are equal.
  explicit PairingQueue(double tolerance = 0.002) : tolerance_ns_(ToNanoseconds(tolerance)) {}

  // Must be called in order of arrival. Drops a sample that goes back in time, unless enough
  // samples follow it there: then a new recording begins.
  void Add(Sample sample) {
    const std::optional<int64_t> last_ns = order_.newest_ns();
    const StampVerdict verdict = order_.Add(sample.t_ns);
    if (!StampOrder::IsAccepted(verdict)) return;
    if (verdict == StampVerdict::kRestarts) {
      samples_.clear();
      interval_ns_ = 0;
    } else if (last_ns) {
      interval_ns_ = sample.t_ns - *last_ns;
    }
    samples_.push_back(std::move(sample));
    while (samples_.front().t_ns < *order_.newest_ns() - kMaxAge_ns) samples_.pop_front();
  }

  // Returns whether the sample for an image with this timestamp is due but has not arrived. A
  // sensor that has not sent anything yet, or has stopped, is not waited for.
  bool IsAwaited(int64_t t_ns) const {
    if (!last_ns()) return false;
    const int64_t ahead_ns = t_ns - *last_ns();
    return ahead_ns > tolerance_ns_ && ahead_ns < kSilence_ns && 4 * ahead_ns >= 3 * interval_ns_;
  }

  // Returns the sample for an image with this timestamp, if there is one. Drops older samples.
  std::optional<Sample> Take(int64_t t_ns) {
    while (!samples_.empty() && samples_.front().t_ns < t_ns - tolerance_ns_) samples_.pop_front();
    if (samples_.empty() || samples_.front().t_ns > t_ns + tolerance_ns_) return std::nullopt;
    std::optional<Sample> taken(std::move(samples_.front()));
    samples_.pop_front();
    return taken;
  }

  // Timestamp of the newest sample.
  std::optional<int64_t> last_ns() const { return order_.newest_ns(); }

 private:
  static constexpr int64_t kMaxAge_ns = 1'000'000'000;  // exceeds the time that any image waits
  static constexpr int64_t kSilence_ns = 500'000'000;

  int64_t tolerance_ns_;
  std::deque<Sample> samples_;
  StampOrder order_{kImageJumps};
  int64_t interval_ns_ = 0;  // interval between the last two samples
};

}  // namespace plm_vins

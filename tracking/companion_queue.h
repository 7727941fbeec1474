// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdlib>
#include <deque>
#include <optional>
#include <utility>

namespace plm_vins {

// Images of a further sensor that wait for the camera image with the same timestamp. `Sample` has
// t_ns. Synchronous; the result depends only on the order of the calls.
template <typename Sample>
class CompanionQueue {
 public:
  static constexpr int64_t kTolerance_ns = 2'000'000;  // closer timestamps are equal

  // Must be called in order of arrival. A timestamp that does not increase begins a new recording.
  void Add(Sample sample) {
    if (last_ns_ && sample.t_ns <= *last_ns_) {
      samples_.clear();
      interval_ns_ = 0;
    } else if (last_ns_) {
      interval_ns_ = sample.t_ns - *last_ns_;
    }
    last_ns_ = sample.t_ns;
    samples_.push_back(std::move(sample));
    while (samples_.front().t_ns < *last_ns_ - kMaxAge_ns) samples_.pop_front();
  }

  // Returns whether the sample for an image with this timestamp is due but has not arrived. A
  // sensor that has not sent anything yet, or has stopped, is not waited for.
  bool IsAwaited(int64_t t_ns) const {
    if (!last_ns_) return false;
    const int64_t ahead_ns = t_ns - *last_ns_;
    return ahead_ns > kTolerance_ns && ahead_ns < kSilence_ns && 4 * ahead_ns >= 3 * interval_ns_;
  }

  // Returns the sample for an image with this timestamp, if there is one. Drops older samples.
  std::optional<Sample> Take(int64_t t_ns) {
    while (!samples_.empty() && samples_.front().t_ns < t_ns - kTolerance_ns) samples_.pop_front();
    if (samples_.empty() || samples_.front().t_ns > t_ns + kTolerance_ns) return std::nullopt;
    std::optional<Sample> taken(std::move(samples_.front()));
    samples_.pop_front();
    return taken;
  }

  // Timestamp of the last sample that was added.
  const std::optional<int64_t>& last_ns() const { return last_ns_; }

 private:
  static constexpr int64_t kMaxAge_ns = 1'000'000'000;  // exceeds the time that any image waits
  static constexpr int64_t kSilence_ns = 500'000'000;

  std::deque<Sample> samples_;
  std::optional<int64_t> last_ns_;
  int64_t interval_ns_ = 0;  // interval between the last two samples
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace plm_vins {

// Distinguishes a restart of a stream's timestamps (a replayed bag, a clock set back) from single
// timestamps out of order. A restart is recognized after more than `patience` consecutive
// increasing rejected timestamps. After a smaller step back, the rejected timestamps catch up with
// the last accepted one, and the next timestamp follows them at their own rate; late single
// messages do not show this pattern.
class BackwardJumpDetector {
 public:
  explicit BackwardJumpDetector(int patience) : patience_(patience) {}

  // Reports a timestamp that follows the last accepted one.
  void Accept() { rejected_in_a_row_ = 0; }

  // Reports a timestamp that does not follow. Returns true if the stream restarts with it.
  bool Reject(int64_t t_ns) {
    const bool in_a_row = rejected_in_a_row_ > 0 && t_ns > rejected_ns_;
    rejected_in_a_row_ = in_a_row ? rejected_in_a_row_ + 1 : 1;
    if (!in_a_row) first_rejected_ns_ = t_ns;
    rejected_ns_ = t_ns;
    return rejected_in_a_row_ > patience_;
  }

  // Returns whether the last timestamp was rejected.
  bool HasRejected() const { return rejected_in_a_row_ > 0; }

  // To be called for a timestamp that follows the last accepted one, before Accept(). Returns true
  // if the stream was restarted at the rejected timestamps.
  bool EndsStepBack(int64_t t_ns) const {
    return rejected_in_a_row_ >= kShortestStep &&
           t_ns - rejected_ns_ <= (rejected_ns_ - first_rejected_ns_) / 2;
  }

 private:
  static constexpr int kShortestStep = 10;  // timestamps; fewer may be late single messages

  int patience_;
  int rejected_in_a_row_ = 0;
  int64_t first_rejected_ns_ = 0;  // first of the consecutive rejected timestamps
  int64_t rejected_ns_ = 0;        // last rejected timestamp
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace plm_vins {

// Distinguishes a gap in a stream of timestamps from a single wrong timestamp in the future, after
// which all others would seem late: the first timestamp after a jump is rejected, and the next one
// confirms the jump.
class ForwardJumpDetector {
 public:
  // A jump is more than `limit_ns` from one timestamp to the next.
  explicit ForwardJumpDetector(int64_t limit_ns) : limit_ns_(limit_ns) {}

  // Returns whether the timestamp is accepted; `last_ns` is the last accepted one.
  bool Accept(int64_t last_ns, int64_t t_ns) {
    const bool leaps = t_ns - last_ns > limit_ns_;
    const bool confirmed = rejected_ns_ && t_ns > *rejected_ns_;
    rejected_ns_.reset();
    if (leaps && !confirmed) rejected_ns_ = t_ns;
    return !leaps || confirmed;
  }

 private:
  int64_t limit_ns_;
  std::optional<int64_t> rejected_ns_;  // the previous timestamp, if it was rejected
};

}  // namespace plm_vins

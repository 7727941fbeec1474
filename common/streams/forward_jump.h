// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace plm_vins {

// Distinguishes a gap in a stream of stamps from a single wrong stamp in the future, which would
// make all that follow look late: the first stamp after a leap is refused, the next one confirms
// the leap.
class ForwardJumpDetector {
 public:
  // More than `limit_ns` from one stamp to the next is a leap.
  explicit ForwardJumpDetector(int64_t limit_ns) : limit_ns_(limit_ns) {}

  // False where the stamp must be refused, `last_ns` being the last that was not.
  bool Accept(int64_t last_ns, int64_t t_ns) {
    const bool leaps = t_ns - last_ns > limit_ns_;
    const bool confirmed = refused_ns_ && t_ns > *refused_ns_;
    refused_ns_.reset();
    if (leaps && !confirmed) refused_ns_ = t_ns;
    return !leaps || confirmed;
  }

 private:
  int64_t limit_ns_;
  std::optional<int64_t> refused_ns_;  // the stamp before, where that was refused
};

}  // namespace plm_vins

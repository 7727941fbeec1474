// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "common/format.h"
#include "common/measurements.h"

namespace plm_vins {

// Detects a stream whose timestamps do not change, or hardly ever, because its driver does not set
// them or rounds them. Considers about the last two hundred messages.
class ConstantStamp {
 public:
  void Add(int64_t t_ns) {
    const bool repeats = messages_ > 0 && t_ns == t_ns_;
    repeated_in_a_row_ = repeats ? repeated_in_a_row_ + 1 : 0;
    const double forgotten = 1.0 / static_cast<double>(std::min(++messages_, kMinRounded));
    share_ += forgotten * ((repeats ? 1 : 0) - share_);
    t_ns_ = t_ns;
  }

  // Returns what is wrong with the timestamps of `topic`; empty if they change or are too few.
  std::string Finding(const std::string& topic) const {
    if (messages_ >= kMinMessages && repeated_in_a_row_ >= std::min(messages_ - 1, kMaxRounded)) {
      return "all stamps of " + topic + " are " +
             (t_ns_ == 0 ? "zero" : Format("the same, %.3f s", ToSeconds(t_ns_))) +
             ": its driver must stamp each message (header.stamp)";
    }
    if (messages_ < kMinRounded || share_ < kMost) return "";
    return Format("%.0f %% of the stamps of ", 100 * share_) + topic +
           " repeat the previous one: its driver must not round them (header.stamp), and only one "
           "node may publish them";
  }

 private:
  static constexpr int64_t kMinMessages = 20, kMinRounded = 210;  // exceeds those of ImuBursts
  static constexpr int64_t kMaxRounded = 1000;  // messages in a row, by whole seconds
  static constexpr double kMost = 0.3;          // two publishers repeat half of them

  int64_t messages_ = 0;
  int64_t repeated_in_a_row_ = 0;
  double share_ = 0;  // of messages with the timestamp of the previous one
  int64_t t_ns_ = 0;  // timestamp of the last message
};

}  // namespace plm_vins

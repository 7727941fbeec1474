// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/format.h"
#include "common/measurements.h"

namespace plm_vins {

// Detects a stream whose timestamps do not change, or hardly ever, because its driver does not set
// them or rounds them.
class ConstantStamp {
 public:
  void Add(int64_t t_ns) {
    if (messages_++ > 0 && t_ns == t_ns_) ++repeated_;
    t_ns_ = t_ns;
  }

  // Returns what is wrong with the timestamps of `topic`; empty if they change or are too few.
  std::string Finding(const std::string& topic) const {
    const double share = static_cast<double>(repeated_) / static_cast<double>(messages_);
    const bool is_constant = repeated_ == messages_ - 1;
    if (messages_ < (is_constant ? kMinMessages : kMinRounded) || share < kMost) return "";
    if (!is_constant) {
      return Format("%.0f %% of the stamps of ", 100 * share) + topic +
             " repeat the previous one: its driver must not round them (header.stamp)";
    }
    return "all stamps of " + topic + " are " +
           (t_ns_ == 0 ? "zero" : Format("the same, %.3f s", ToSeconds(t_ns_))) +
           ": its driver must stamp each message (header.stamp)";
  }

 private:
  static constexpr int64_t kMinMessages = 20, kMinRounded = 100;
  static constexpr double kMost = 0.7;  // two sources of the same messages repeat half of them

  int64_t messages_ = 0;
  int64_t repeated_ = 0;  // messages with the timestamp of the previous one
  int64_t t_ns_ = 0;      // timestamp of the last message
};

}  // namespace plm_vins

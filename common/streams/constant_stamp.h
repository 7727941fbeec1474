// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/format.h"
#include "common/measurements.h"

namespace plm_vins {

// Detects a stream whose timestamps never change because its driver does not set them.
class ConstantStamp {
 public:
  void Add(int64_t t_ns) {
    if (messages_++ == 0) t_ns_ = t_ns;
    differs_ = differs_ || t_ns != t_ns_;
  }

  // Returns what is wrong with the timestamps of `topic`; empty if they change or are too few.
  std::string Finding(const std::string& topic) const {
    if (differs_ || messages_ < kMinMessages) return "";
    return "all stamps of " + topic + " are " +
           (t_ns_ == 0 ? "zero" : Format("the same, %.3f s", ToSeconds(t_ns_))) +
           ": its driver must stamp each message (header.stamp)";
  }

 private:
  static constexpr int64_t kMinMessages = 20;

  int64_t messages_ = 0;
  int64_t t_ns_ = 0;  // timestamp of the first message
  bool differs_ = false;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "common/format.h"

namespace plm_vins {

// The fault that a check has found: the topic or key, what is wrong with it, and what to do.
struct Finding {
  std::string text;         // empty if there was none
  bool is_present = false;  // false: it has passed; the text says until when it lasted
  double sigmas = 0;        // as in RankedFinding; less once it has passed
};

// A finding, and by how many standard deviations of what good sensors and calibrations have it
// exceeds that. So the findings of different checks compare: the first cause to look at is the one
// that is most certainly wrong.
struct RankedFinding {
  std::string text;  // empty if there is none
  double sigmas = 0;
};

// Remembers the newest finding of a check, so that a fault that has passed can be told from one
// that lasts.
class FindingMemory {
 public:
  // Sets what is found at this time of the data; empty if nothing is. Returns whether a finding
  // begins.
  bool Set(int64_t t_ns, const std::string& text, double sigmas = 1) {
    const bool was_present = finding_.is_present;
    finding_.is_present = !text.empty();
    if (finding_.is_present) {
      finding_.text = text;
      finding_.sigmas = sigmas;
    } else if (was_present) {
      finding_.text += " (until " + TimeOfDay(t_ns) + " UTC)";
      finding_.sigmas *= kPassed;
    }
    return finding_.is_present && !was_present;
  }

  const Finding& finding() const { return finding_; }

 private:
  static constexpr double kPassed = 0.3;  // weight of what has passed

  static std::string TimeOfDay(int64_t t_ns) {
    const auto seconds = static_cast<int>(t_ns / 1'000'000'000 % 86'400);
    return Format("%02d:%02d:%02d", seconds / 3600, seconds / 60 % 60, seconds % 60);
  }

  Finding finding_;
};

}  // namespace plm_vins

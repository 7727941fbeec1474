// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace plm_vins {

// Time for which a condition has held lately; decays half as fast as it grows.
class RecentTime {
 public:
  // Adds an interval [s] during which the condition held or did not.
  void Add(double interval, bool holds) {
    seconds_ = std::clamp(seconds_ + (holds ? interval : -0.5 * interval), 0.0, kMost);
  }

  // Returns whether it has held so long that it is no accident.
  bool IsLong() const { return seconds_ > kLong; }

 private:
  static constexpr double kLong = 2, kMost = 6;  // [s]

  double seconds_ = 0;
};

}  // namespace plm_vins

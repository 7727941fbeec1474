// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

#include "common/measurements.h"
#include "common/statistics.h"

namespace plm_vins {

// Interval statistics of a stream's newest 101 timestamps, which must increase.
class StreamRhythm {
 public:
  void Add(int64_t t_ns) {
    if (!stamps_.empty() && t_ns <= stamps_.back()) stamps_.clear();
    stamps_.push_back(t_ns);
    if (stamps_.size() > kStamps) stamps_.pop_front();
  }

  // Median interval [s]; zero while there are too few timestamps.
  double Interval() const { return stamps_.size() < kStamps ? 0 : Median(Intervals()); }

  // Root mean square deviation of intervals from the median, or from a multiple of it if timestamps
  // are missing [s].
  double Jitter() const {
    const double usual = Interval();
    if (usual == 0) return 0;
    double sum = 0;
    for (const double interval : Intervals()) {
      const double multiple = std::max(1.0, std::round(interval / usual));
      sum += std::pow(interval - multiple * usual, 2);
    }
    return std::sqrt(sum / static_cast<double>(stamps_.size() - 1));
  }

 private:
  static constexpr size_t kStamps = 101;

  std::vector<double> Intervals() const {
    std::vector<double> intervals;
    for (size_t i = 1; i < stamps_.size(); ++i) {
      intervals.push_back(ToSeconds(stamps_[i] - stamps_[i - 1]));
    }
    return intervals;
  }

  std::deque<int64_t> stamps_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// Samples farther apart than this leave a gap: the motion between them is unknown, not just noisy.
constexpr double kMaxImuInterval = 0.05;  // [s]

// Returns whether these samples, ordered by time, leave a gap.
inline bool LeaveGap(const std::vector<ImuSample>& samples) {
  const auto is_gap = [](const ImuSample& begin, const ImuSample& end) {
    return ToSeconds(end.t_ns - begin.t_ns) > kMaxImuInterval;
  };
  return std::adjacent_find(samples.begin(), samples.end(), is_gap) != samples.end();
}

}  // namespace plm_vins

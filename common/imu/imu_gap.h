// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// Samples farther apart than this leave a gap: the motion between them is unknown, not just noisy.
constexpr double kMaxImuInterval = 0.05;  // [s]

inline bool IsGap(int64_t begin_ns, int64_t end_ns) {
  return ToSeconds(end_ns - begin_ns) > kMaxImuInterval;
}

// Returns whether these samples, ordered by time, leave a gap.
inline bool LeaveGap(const std::vector<ImuSample>& samples) {
  const auto is_gap = [](const ImuSample& a, const ImuSample& b) { return IsGap(a.t_ns, b.t_ns); };
  return std::adjacent_find(samples.begin(), samples.end(), is_gap) != samples.end();
}

}  // namespace plm_vins

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

// Interpolates linearly at `t_ns` between two readings; `a` must be earlier than `b`. Returns `a`
// or `b` unchanged if `t_ns` equals its timestamp.
inline ImuSample InterpolateImu(const ImuSample& a, const ImuSample& b, int64_t t_ns) {
  if (t_ns == a.t_ns) return a;
  if (t_ns == b.t_ns) return b;
  const double fraction = static_cast<double>(t_ns - a.t_ns) / static_cast<double>(b.t_ns - a.t_ns);
  return {t_ns, a.gyro + fraction * (b.gyro - a.gyro), a.accel + fraction * (b.accel - a.accel),
          a.gyro_doubt + fraction * (b.gyro_doubt - a.gyro_doubt),
          a.accel_doubt + fraction * (b.accel_doubt - a.accel_doubt)};
}

}  // namespace plm_vins

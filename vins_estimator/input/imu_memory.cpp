// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/imu_memory.h"

#include <algorithm>

namespace plm_vins {

void ImuMemory::Add(const ImuSample& sample) {
  samples_.push_back(sample);
  while (sample.t_ns - samples_.front().t_ns > kSpan_ns) samples_.pop_front();
}

bool ImuMemory::Contains(const ImuSample& sample) const {
  const auto found =
      std::lower_bound(samples_.begin(), samples_.end(), sample.t_ns,
                       [](const ImuSample& known, int64_t t_ns) { return known.t_ns < t_ns; });
  return found != samples_.end() && found->t_ns == sample.t_ns && found->gyro == sample.gyro &&
         found->accel == sample.accel;
}

}  // namespace plm_vins

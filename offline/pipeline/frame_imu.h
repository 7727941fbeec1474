// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/imu/imu_gate.h"
#include "common/measurements.h"

namespace plm_vins {

// The IMU samples of a run, to be taken frame by frame: in order of time, none twice, and as the
// estimator has them, without those that no sensor gives or that are out of order, and with
// outliers replaced (ImuGate).
class FrameImu {
 public:
  explicit FrameImu(const ImuRange& range);

  void Add(const ImuSample& sample);

  // Those up to this time that have not been taken.
  std::vector<ImuSample> Take(int64_t t_ns);

  // Stamps went back for good: samples that have not been taken are void.
  void Clear();

 private:
  void Keep(const ImuSample& sample);

  std::deque<ImuSample> samples_;
  std::optional<int64_t> last_ns_;      // of the newest sample that went to the gate
  std::optional<ImuSample> after_gap_;  // waits for the next: its stamp may be wrong
  ImuGate gate_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {

// Stores the IMU samples of a run. A backward jump of the timestamps starts another recording,
// whose timestamps may overlap those of earlier recordings. Recordings are numbered from zero.
class ImuHistory {
 public:
  // Ignores a repeated timestamp.
  void Add(const ImuSample& sample);

  // Drops the samples that only times strictly between these two need.
  void Forget(int recording, int64_t from_ns, int64_t to_ns);

  // Number of the newest sample's recording; -1 if there are no samples.
  int newest() const { return static_cast<int>(recordings_.size()) - 1; }

  // Preintegrates the samples between two times of a recording, interpolated at both ends. Returns
  // nullopt if the samples do not cover the interval. None of them may have been dropped.
  std::optional<Preintegration> Between(int recording, int64_t from_ns, int64_t to_ns,
                                        const ImuNoise& noise, const ImuBias& bias) const;

 private:
  std::vector<std::deque<ImuSample>> recordings_;  // each in temporal order
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {

// The IMU samples of a run.
class ImuHistory {
 public:
  // Where stamps jump back the history begins anew. A stamp for the second time is left out.
  void Add(const ImuSample& sample);

  // What was measured between two times, each end interpolated. Nothing where the samples do not
  // reach over both.
  std::optional<Preintegration> Between(int64_t from_ns, int64_t to_ns, const ImuNoise& noise,
                                        const ImuBias& bias) const;

 private:
  std::vector<ImuSample> samples_;  // in order of time
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {

// The IMU samples of a run. Where stamps jump back another recording begins, of which stamps may
// be those of one before; recordings count up from zero.
class ImuHistory {
 public:
  // A stamp for the second time is left out.
  void Add(const ImuSample& sample);

  // The recording of the newest sample; -1: there is none.
  int newest() const { return static_cast<int>(recordings_.size()) - 1; }

  // What was measured between two times of a recording, each end interpolated. Nothing where its
  // samples do not reach over both.
  std::optional<Preintegration> Between(int recording, int64_t from_ns, int64_t to_ns,
                                        const ImuNoise& noise, const ImuBias& bias) const;

 private:
  std::vector<std::vector<ImuSample>> recordings_;  // each in order of time
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/initialization/extrinsic_rotation.h"

namespace plm_vins {

// Collects turns of the rig, image after image, until they determine the camera's rotation in the
// body. No initial guess is needed. Bounded memory; deterministic.
class ExtrinsicCalibrator {
 public:
  // `noise`: standard deviation of a normalised coordinate.
  ExtrinsicCalibrator(const ImuNoise& imu_noise, double noise)
      : imu_noise_(imu_noise), noise_(noise) {}

  // Takes the newest of `frames`, which lead without gap to it; R_B_C as soon as it is determined.
  // Else nothing, and the reason in words.
  std::optional<Eigen::Quaterniond> Add(const std::deque<FrameMeasurement>& frames,
                                        std::string* reason);

 private:
  std::optional<RotationPair> MeasurePair(const std::deque<FrameMeasurement>& frames,
                                          std::string* reason) const;

  ImuNoise imu_noise_;
  double noise_;
  std::vector<RotationPair> pairs_;  // oldest first
  std::optional<int64_t> last_ns_;   // newest image of the last pair tried
};

}  // namespace plm_vins

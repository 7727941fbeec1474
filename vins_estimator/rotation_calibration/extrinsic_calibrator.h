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
#include "vins_estimator/rotation_calibration/extrinsic_rotation.h"

namespace plm_vins {

// Calibrates the camera's rotation in the body from rotations of the rig, image by image, until it
// is observable. Needs no initial guess. Its memory is bounded; its result is deterministic.
class ExtrinsicCalibrator {
 public:
  // `noise` is the standard deviation of a normalized coordinate.
  ExtrinsicCalibrator(const ImuNoise& imu_noise, double noise)
      : imu_noise_(imu_noise), noise_(noise) {}

  // Adds the newest of `frames`, which must be contiguous. Returns R_B_C once it is certain enough;
  // otherwise nullopt, with the reason.
  std::optional<Eigen::Quaterniond> Add(const std::deque<FrameMeasurement>& frames,
                                        std::string* reason);

 private:
  ImuNoise imu_noise_;
  double noise_;
  std::vector<RotationPair> pairs_;  // oldest first
  std::optional<int64_t> last_ns_;   // newest image of the last attempted pair
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "vins_estimator/rotation_calibration/extrinsic_rotation.h"

namespace plm_vins {

// A gross error of the camera's rotation in the body, or of the gyro's axes, of the kinds that
// occur.
struct MountingError {
  enum class Kind {
    kInverse,   // the inverse was given
    kTurned,    // the image is turned
    kMirrored,  // the image is mirrored, or the camera's axes are not x right, y down, z forward
    kGyro       // the gyro's axes are left-handed: signs are wrong, or two axes are swapped
  };
  Kind kind = Kind::kInverse;
  double angle = 0;       // of the error; of a turned image about the optical axis, signed [rad]
  std::string gyro = {};  // what is wrong with the gyro
};

// Returns the error that explains the pairs if the configured rotation does not: needs rotations
// about one axis only. Returns nullopt if there is none, or too few rotations.
std::optional<MountingError> ExplainByMounting(const std::vector<RotationPair>& pairs,
                                               const Eigen::Quaterniond& R_B_C);

}  // namespace plm_vins

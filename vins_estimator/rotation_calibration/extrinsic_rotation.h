// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "vins_estimator/structure_from_motion/tracks.h"

namespace plm_vins {

// A rotation of the rig, measured by the gyroscope and by the camera.
struct RotationPair {
  Eigen::Quaterniond R_B0_B1;  // integrated without bias correction
  Eigen::Quaterniond R_then_now;
  double duration = 0;   // [s]
  double deviation = 0;  // standard deviation of their difference, per axis [rad]
  Eigen::Vector3d rate_change = Eigen::Vector3d::Zero();  // of the gyroscope, from 0 to 1 [rad/s]
  std::vector<Correspondence> points = {};                // some that both images observe
};

struct ExtrinsicRotationOptions {
  size_t min_pairs = 30;
  double min_second_turn = 0.015;    // rms rotation per pair about all but the main axis [rad]
  double max_deviation = 0.015;      // deviation about the least certain axis [rad]
  double gyro_bias_deviation = 0.1;  // prior of the bias about 0 [rad/s]
};

// Calibrates the camera's rotation in the body from R_B0_B1 R_B_C = R_B_C R_then_now over many
// pairs: linear least squares on the quaternion ([Chou1991], reweighted by the angular residual),
// then a robust refinement together with the gyroscope bias, which the linear solution would
// attribute to the rotation. Returns nullopt, with the reason, if there are too few pairs, if they
// are inconsistent, or if rotations about a single axis leave the angle about that axis
// unobservable.
std::optional<Eigen::Quaterniond> CalibrateExtrinsicRotation(
    const std::vector<RotationPair>& pairs, const ExtrinsicRotationOptions& options,
    std::string* reason);

}  // namespace plm_vins

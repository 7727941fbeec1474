// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace plm_vins {

// One turn of the rig, as the gyro and as the camera measured it.
struct RotationPair {
  Eigen::Quaterniond R_B0_B1;  // integrated without knowing the gyro bias
  Eigen::Quaterniond R_C0_C1;
  double duration = 0;   // [s]
  double deviation = 0;  // standard deviation of both together, per axis [rad]
};

struct ExtrinsicRotationOptions {
  size_t min_pairs = 30;
  double min_second_turn = 0.015;    // per pair, about axes other than the main one, rms [rad]
  double max_deviation = 0.015;      // standard deviation of the result about its worst axis [rad]
  double gyro_bias_deviation = 0.1;  // of the bias about 0 [rad/s]
};

// Rotation of the camera in the body from R_B0_B1 R_B_C = R_B_C R_C0_C1 over many pairs: linear
// least squares over the quaternion ([Chou1991], reweighted by the angle left), then a robust
// refinement together with the gyro bias, which a linear solution would take for rotation.
// Turns about a single axis leave the angle about it open: nothing, and the reason in words, then,
// and where pairs are too few or contradict each other.
std::optional<Eigen::Quaterniond> CalibrateExtrinsicRotation(
    const std::vector<RotationPair>& pairs, const ExtrinsicRotationOptions& options,
    std::string* reason);

}  // namespace plm_vins

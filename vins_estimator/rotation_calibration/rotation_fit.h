// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "vins_estimator/rotation_calibration/extrinsic_rotation.h"

namespace plm_vins {

// The error of the calibration that explains best why the rotations of the camera differ from those
// of the gyroscope.
struct RotationFit {
  enum class Cause { kUnknown, kNone, kTimeOffset, kFocalLength, kExtrinsics, kGyro };
  Cause cause = Cause::kUnknown;
  // Correction of td [s], relative error of the configured focal length, error of the extrinsics
  // [rad], or largest relative error of the gyroscope's scale and axes.
  double amount = 0;
};

// Fits the differences of many pairs by linear least squares, robustly, once for each cause, each
// with a bias of the gyroscope. The best fit by the Bayesian information criterion is the cause if
// it explains a good part of the differences and its amount matters. There is none if the rotations
// agree; it is unknown if they do not, or if there are too few. A wrong focal length is visible in
// rotation without much translation only. `R_B_C` is as configured and right within some degrees.
RotationFit ExplainRotations(const std::vector<RotationPair>& pairs,
                             const Eigen::Quaterniond& R_B_C);

// Returns the smallest amount of an error that matters.
double LeastAmount(RotationFit::Cause cause);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "vins_estimator/rotation_calibration/extrinsic_rotation.h"

namespace plm_vins {

// The error of the calibration that explains best why the motion of points in the image does not
// agree with the rotation of the gyroscope.
struct RotationFit {
  enum class Cause {
    kUnknown,
    kNone,
    kTimeOffset,
    kFocalLength,
    kDistortion,
    kPrincipalPoint,
    kExtrinsics,
    kGyro
  };
  Cause cause = Cause::kUnknown;
  // Correction of td [s], relative error of the configured focal length, relative error of the rays
  // at the edge of the image, error of the principal point in focal lengths, error of the
  // extrinsics [rad], or largest relative error of the gyroscope's scale and axes.
  double amount = 0;
};

// Fits the errors of each cause to the epipolar constraint of the pairs' points
// (epipolar_equations.h), each with a bias of the gyroscope. The best fit by the Bayesian
// information criterion is the cause if it explains a good part of the cost and its amount matters.
// There is none if the points agree with the gyroscope; it is unknown if they do not, or if there
// are too few rotations. `R_B_C` is as configured and right within some degrees; `noise` is the
// standard deviation of a normalized coordinate.
RotationFit ExplainRotations(const std::vector<RotationPair>& pairs,
                             const Eigen::Quaterniond& R_B_C, double noise);

// Returns the smallest amount of an error that matters.
double LeastAmount(RotationFit::Cause cause);

}  // namespace plm_vins

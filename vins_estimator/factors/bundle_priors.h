// SPDX-License-Identifier: BSD-3-Clause
// Priors that fix the unobservable directions of a visual-inertial bundle at their initial values.
#pragma once

#include <Eigen/Core>

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Fixes position and heading of a pose:
//   r = [p - p0, e_z^T R0 Log(R0^T R)] / deviation,
// whose last component is the rotation about the world's z axis. Block: pose (7), with the Jacobian
// of factors/manifolds.h.
class GaugePrior final : public SizedFactor<4, kPoseSize> {
 public:
  // `deviation` is the standard deviation, in [m] and in [rad].
  GaugePrior(const FrameState& state, double deviation) : state_(state), deviation_(deviation) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  FrameState state_;
  double deviation_;
};

// Gaussian prior on the biases of a frame:
//   r = [(b_a - b_a0) / deviation_a, (b_g - b_g0) / deviation_g].
// Block: motion (9).
class BiasPrior final : public SizedFactor<6, 9> {
 public:
  BiasPrior(const ImuBias& mean, double accel_deviation, double gyro_deviation);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::Matrix<double, 6, 1> mean_, weights_;
};

}  // namespace plm_vins

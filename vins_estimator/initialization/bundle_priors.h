// SPDX-License-Identifier: BSD-3-Clause
// What a bundle of images and IMU leaves undetermined is held at what it starts from.
#pragma once

#include <Eigen/Core>

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Holds position and heading of a pose:
//   r = [p - p0, e_z^T R0 Log(R0^T R)] / deviation,
// the last of which is the turn about the world's z. Block: pose (7), with the Jacobian of
// factors/manifolds.h.
class GaugePrior final : public SizedFactor<4, kPoseSize> {
 public:
  // `deviation`: [m] and [rad] alike.
  GaugePrior(const FrameState& state, double deviation) : state_(state), deviation_(deviation) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  FrameState state_;
  double deviation_;
};

// Holds the biases of a frame softly: r = [(b_a - b_a0) / deviation_a, (b_g - b_g0) / deviation_g].
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

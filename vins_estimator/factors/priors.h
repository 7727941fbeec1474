// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/geometry/rigid3.h"
#include "vins_estimator/factors/factor.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Fixes position and heading of a pose, which are unobservable:
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

// Standard deviations of the configured pose of one camera in another.
struct RelativePoseDeviation {
  double across;    // position across the baseline [m]
  double along;     // position along the baseline, which is an error of its length [m]
  double rotation;  // [rad]
};

// Prior on the pose of a camera j in a camera i, T = T_B_Ci^-1 T_B_Cj, whose configured value is
// T0:
//   r = [ E^T (t - t0) / deviations, Log(R0^T R) / deviation ],
// with two columns of E across the baseline t0 and one along it. Blocks: extrinsics T_B_Ci (7),
// T_B_Cj (7). Jacobians follow factors/manifolds.h.
class ExtrinsicsPrior final : public SizedFactor<6, kPoseSize, kPoseSize> {
 public:
  ExtrinsicsPrior(const Rigid3d& T_Ci_Cj, const RelativePoseDeviation& deviation);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::Vector3d t0_;
  Eigen::Matrix3d R0_;
  Eigen::Matrix3d position_weight_;
  double rotation_weight_;
};

}  // namespace plm_vins

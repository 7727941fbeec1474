// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Derivatives of ImuResidual in the tangents of pose (factors/manifolds.h) and motion.
struct ImuResidualJacobians {
  Eigen::Matrix<double, 15, 6> d_residual_d_pose_i, d_residual_d_pose_j;
  Eigen::Matrix<double, 15, 9> d_residual_d_motion_i, d_residual_d_motion_j;

  // Derivatives with respect to whole states, pose before motion.
  Matrix15d ByFirst() const {
    return (Matrix15d() << d_residual_d_pose_i, d_residual_d_motion_i).finished();
  }
  Matrix15d BySecond() const {
    return (Matrix15d() << d_residual_d_pose_j, d_residual_d_motion_j).finished();
  }
};

// Computes the difference between the motion of two states and the preintegrated measurement, not
// whitened; rows as in ImuErrorIndex. [Forster2017] Eq. (45), plus the bias changes:
//   r_p  = R_i^T (p_j - p_i - v_i T - g T^2 / 2) - delta_p(b_i)
//   r_th = Log(delta_q(b_i)^-1 q_i^-1 q_j)
//   r_v  = R_i^T (v_j - v_i - g T) - delta_v(b_i)
//   r_ba = ba_j - ba_i,   r_bg = bg_j - bg_i
// The Jacobians are exact (no small-angle step); `jacobians` may be null.
Vector15d ImuResidual(const Preintegration& preintegration, const Eigen::Vector3d& gravity_W,
                      const FrameState& state_i, const FrameState& state_j,
                      ImuResidualJacobians* jacobians);

// Returns the squared Mahalanobis norm of the residual.
double ImuChiSquare(const Preintegration& preintegration, const Eigen::Vector3d& gravity_W,
                    const FrameState& state_i, const FrameState& state_j);

// Whitened ImuResidual as a factor on pose_i, motion_i, pose_j, motion_j. The preintegration
// belongs to the window: it must outlive the factor and not change while the factor is in use.
class ImuFactor final : public SizedFactor<15, 7, 9, 7, 9> {
 public:
  // `gravity_W` is (0, 0, -g) [m/s^2].
  ImuFactor(const Preintegration* preintegration, const Eigen::Vector3d& gravity_W)
      : preintegration_(preintegration), gravity_W_(gravity_W) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const Preintegration* preintegration_;
  Eigen::Vector3d gravity_W_;
};

}  // namespace plm_vins

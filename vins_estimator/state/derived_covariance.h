// SPDX-License-Identifier: BSD-3-Clause
// Covariances of quantities derived from a state. Rotations are perturbed on the right, R_W_B
// Exp(theta).
#pragma once

#include <Eigen/Core>

#include "common/geometry/so3.h"
#include "vins_estimator/state/estimator_output.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Returns the position variance, summed over the axes [m^2], without the part due to the heading
// error since `pivot_W`: that error rotates the whole trajectory about the vertical through the
// pivot, which is a change of the frame and not drift. `pose_covariance` is that of (p_W, theta).
inline double PositionVarianceFrom(const Eigen::Vector3d& pivot_W, const FrameState& state,
                                   const Eigen::Matrix<double, 6, 6>& pose_covariance) {
  const Eigen::Vector3d up_B = state.rotation().conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d across_W = Eigen::Vector3d::UnitZ().cross(state.position() - pivot_W);
  Eigen::Matrix<double, 3, 6> J;
  J << Eigen::Matrix3d::Identity(), -across_W * up_B.transpose();
  return (J * pose_covariance * J.transpose()).trace();
}

// Returns the covariance of v_B = R_W_B^T v_W [m^2/s^2]. Heading errors that rotate v_W as well
// cancel out in the body frame. `covariance` is that of (theta, v_W).
inline Eigen::Matrix3d BodyVelocityCovariance(const FrameState& state,
                                              const Eigen::Matrix<double, 6, 6>& covariance) {
  const Eigen::Matrix3d R_B_W = state.rotation().toRotationMatrix().transpose();
  Eigen::Matrix<double, 3, 6> J;
  J << Skew(R_B_W * state.velocity()), R_B_W;
  return J * covariance * J.transpose();
}

// Adds a relative deviation of the scale, which moves all positions relative to the origin of W.
inline void AddScaleDeviation(double deviation, const FrameState& state, StateUncertainty* known) {
  const Eigen::Vector3d p_W = deviation * state.position(), v_W = deviation * state.velocity();
  const Eigen::Vector3d v_B = state.rotation().conjugate() * v_W;
  known->pose.topLeftCorner<3, 3>() += p_W * p_W.transpose();
  known->velocity += v_W * v_W.transpose();
  known->body_velocity += v_B * v_B.transpose();
}

}  // namespace plm_vins

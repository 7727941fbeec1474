// SPDX-License-Identifier: BSD-3-Clause
#include "mavros_relay/body_odometry.h"

#include <cmath>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

using Matrix6d = BodyOdometry::Matrix6d;

constexpr double kMaxNormError = 1e-6;  // error of a quaternion's norm

// p_A = p_B + R_W_B t, with t from B to A: a rotation by theta about the axes of W moves p_A by
// theta x (R_W_B t).
Matrix6d PoseJacobian(const Eigen::Vector3d& lever_W) {
  Matrix6d J = Matrix6d::Identity();
  J.topRightCorner<3, 3>() = -Skew(lever_W);
  return J;
}

// v_A = R_A_B (v_B + omega_B x t), omega_A = R_A_B omega_B.
Matrix6d TwistJacobian(const Eigen::Matrix3d& R_A_B, const Eigen::Vector3d& lever_B) {
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R_A_B;
  J.topRightCorner<3, 3>() = -R_A_B * Skew(lever_B);
  J.bottomRightCorner<3, 3>() = R_A_B;
  return J;
}

}  // namespace

bool BodyOdometry::IsUsable() const {
  return T_W_B.translation.allFinite() && std::abs(T_W_B.rotation.norm() - 1) < kMaxNormError &&
         v_B.allFinite() && omega_B.allFinite() && pose_covariance.allFinite() &&
         twist_covariance.allFinite();
}

BodyOdometry MoveTo(const Rigid3d& T_B_A, const BodyOdometry& of_B) {
  const Eigen::Vector3d& lever_B = T_B_A.translation;
  const Matrix6d d_pose = PoseJacobian(of_B.T_W_B.rotation * lever_B);
  const Matrix6d d_twist = TwistJacobian(T_B_A.R().transpose(), lever_B);
  BodyOdometry of_A;
  of_A.T_W_B = of_B.T_W_B * T_B_A;
  of_A.v_B = T_B_A.rotation.conjugate() * (of_B.v_B + of_B.omega_B.cross(lever_B));
  of_A.omega_B = T_B_A.rotation.conjugate() * of_B.omega_B;
  of_A.pose_covariance = d_pose * of_B.pose_covariance * d_pose.transpose();
  of_A.twist_covariance = d_twist * of_B.twist_covariance * d_twist.transpose();
  return of_A;
}

}  // namespace plm_vins

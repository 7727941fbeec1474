// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/zero_velocity_factor.h"

#include <Eigen/Core>

#include "common/geometry/so3.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {
namespace {

using PoseJacobian = Eigen::Matrix<double, 6, kPoseSize, Eigen::RowMajor>;

}  // namespace

bool ZeroVelocityFactor::Evaluate(double const* const* parameters, double* residuals,
                                  double** jacobians) const {
  Eigen::Map<Eigen::Vector3d> residual(residuals);
  residual = weight_ * Eigen::Map<const Eigen::Vector3d>(parameters[0]);
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  Eigen::Map<Eigen::Matrix<double, 3, 9, Eigen::RowMajor>> d_residual_d_motion(jacobians[0]);
  d_residual_d_motion.setZero();
  d_residual_d_motion.leftCols<3>().diagonal().setConstant(weight_);
  return true;
}

bool SamePoseFactor::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  Eigen::Matrix<double, 6, 1> difference;
  PoseMinus(parameters[1], parameters[0], difference.data());
  const Eigen::Vector3d angle = difference.tail<3>();
  Eigen::Map<Eigen::Matrix<double, 6, 1>> residual(residuals);
  residual << position_weight_ * difference.head<3>(), rotation_weight_ * angle;
  if (jacobians == nullptr) return true;

  // Log(Exp(-d_i) q_i^-1 q_j Exp(d_j)): right Jacobian for d_j, left one (its transpose) for d_i.
  const Eigen::Matrix3d right_inverse = SO3RightJacobianInverse(angle);
  if (jacobians[0] != nullptr) {
    Eigen::Map<PoseJacobian> d_residual_d_pose_i(jacobians[0]);
    d_residual_d_pose_i.setZero();
    d_residual_d_pose_i.topLeftCorner<3, 3>().diagonal().setConstant(-position_weight_);
    d_residual_d_pose_i.block<3, 3>(3, 3) = -rotation_weight_ * right_inverse.transpose();
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<PoseJacobian> d_residual_d_pose_j(jacobians[1]);
    d_residual_d_pose_j.setZero();
    d_residual_d_pose_j.topLeftCorner<3, 3>().diagonal().setConstant(position_weight_);
    d_residual_d_pose_j.block<3, 3>(3, 3) = rotation_weight_ * right_inverse;
  }
  return true;
}

}  // namespace plm_vins

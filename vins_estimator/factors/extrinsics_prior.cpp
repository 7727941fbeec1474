// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/extrinsics_prior.h"

#include "common/geometry/so3.h"
#include "common/geometry/tangent_basis.h"
#include "vins_estimator/factors/pose_block.h"

namespace plm_vins {
namespace {

using Matrix63d = Eigen::Matrix<double, 6, 3>;

// Returns the weights of a position by its components across and along the baseline, of which only
// the direction matters. Without a baseline, any direction will do.
Eigen::Matrix3d PositionWeight(const Eigen::Vector3d& baseline,
                               const RelativePoseDeviation& deviation) {
  const bool exists = baseline.norm() > 0;
  const Eigen::Vector3d along = exists ? baseline.normalized() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d weight;
  weight << TangentBasis(along).transpose() / deviation.across, along.transpose() / deviation.along;
  return weight;
}

}  // namespace

ExtrinsicsPrior::ExtrinsicsPrior(const Rigid3d& T_Ci_Cj, const RelativePoseDeviation& deviation)
    : t0_(T_Ci_Cj.translation),
      R0_(T_Ci_Cj.R()),
      position_weight_(PositionWeight(t0_, deviation)),
      rotation_weight_(1 / deviation.rotation) {}

bool ExtrinsicsPrior::Evaluate(double const* const* parameters, double* residuals,
                               double** jacobians) const {
  const PoseBlock T_B_Ci(parameters[0]), T_B_Cj(parameters[1]);
  const Eigen::Matrix3d R_Ci_B = T_B_Ci.R.transpose(), R = R_Ci_B * T_B_Cj.R;
  const Eigen::Vector3d t = R_Ci_B * (T_B_Cj.p - T_B_Ci.p);
  const Eigen::Vector3d turn = SO3Log(Eigen::Quaterniond(Eigen::Matrix3d(R0_.transpose() * R)));
  Eigen::Map<Eigen::Matrix<double, 6, 1>> residual(residuals);
  residual << position_weight_ * (t - t0_), rotation_weight_ * turn;
  if (jacobians == nullptr) return true;
  const Eigen::Matrix3d d_position = position_weight_ * R_Ci_B;
  const Eigen::Matrix3d d_turn = rotation_weight_ * SO3RightJacobianInverse(turn);
  Matrix63d by_position = Matrix63d::Zero(), by_rotation = Matrix63d::Zero();
  by_position.topRows<3>() = d_position;
  by_rotation.bottomRows<3>() = d_turn;
  if (jacobians[1]) SetPoseJacobian<6>(by_position, by_rotation, jacobians[1]);
  by_rotation << position_weight_ * Skew(t), -d_turn * R.transpose();
  if (jacobians[0]) SetPoseJacobian<6>(-by_position, by_rotation, jacobians[0]);
  return true;
}

}  // namespace plm_vins

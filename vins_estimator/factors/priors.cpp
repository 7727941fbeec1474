// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/priors.h"

#include <array>

#include "common/geometry/so3.h"
#include "common/geometry/tangent_basis.h"
#include "vins_estimator/factors/manifolds.h"

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

bool GaugePrior::Evaluate(double const* const* parameters, double* residuals,
                          double** jacobians) const {
  std::array<double, kPoseTangentSize> delta;
  PoseMinus(parameters[0], state_.pose.data(), delta.data());
  const Eigen::Map<const Eigen::Vector3d> dp(delta.data()), theta(delta.data() + 3);
  const Eigen::RowVector3d z_axis = state_.rotation().toRotationMatrix().row(2);
  Eigen::Map<Eigen::Vector4d> residual(residuals);
  residual << dp, z_axis.dot(theta);
  residual /= deviation_;
  if (jacobians && jacobians[0]) {
    Eigen::Map<Eigen::Matrix<double, 4, kPoseSize, Eigen::RowMajor>> J(jacobians[0]);
    J.setZero();
    J.topLeftCorner<3, 3>().setIdentity();
    J.block<1, 3>(3, 3) = z_axis * SO3RightJacobianInverse(theta);
    J /= deviation_;
  }
  return true;
}

BiasPrior::BiasPrior(const ImuBias& mean, double accel_deviation, double gyro_deviation) {
  mean_ << mean.accel, mean.gyro;
  weights_ << Eigen::Vector3d::Constant(1 / accel_deviation),
      Eigen::Vector3d::Constant(1 / gyro_deviation);
}

bool BiasPrior::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const Eigen::Map<const Vector6> bias(parameters[0] + 3);
  Eigen::Map<Vector6> residual(residuals);
  residual = weights_.cwiseProduct(bias - mean_);
  if (jacobians && jacobians[0]) {
    Eigen::Map<Eigen::Matrix<double, 6, 9, Eigen::RowMajor>> J(jacobians[0]);
    J.setZero();
    J.rightCols<6>() = weights_.asDiagonal();
  }
  return true;
}

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

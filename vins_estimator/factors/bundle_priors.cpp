// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/bundle_priors.h"

#include <array>

#include "common/geometry/so3.h"

namespace plm_vins {

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

}  // namespace plm_vins

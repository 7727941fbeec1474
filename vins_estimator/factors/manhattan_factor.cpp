// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/manhattan_factor.h"

#include <Eigen/Geometry>

#include "common/geometry/so3.h"
#include "common/geometry/tangent_basis.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {
namespace {

using Matrix23d = Eigen::Matrix<double, 2, 3>;
using Vector2Map = Eigen::Map<Eigen::Vector2d>;
using LineJacobian = Eigen::Map<Eigen::Matrix<double, 2, kLineSize, Eigen::RowMajor>>;

}  // namespace

ManhattanFactor::ManhattanFactor(const Eigen::Vector3d& axis_W, double weight)
    : across_(weight * TangentBasis(axis_W).transpose()) {}

bool ManhattanFactor::Evaluate(double const* const* parameters, double* residuals,
                               double** jacobians) const {
  const PoseBlock T_W_B(parameters[0]), T_B_C(parameters[1]);
  const Eigen::Matrix3d U = Eigen::Map<const Eigen::Quaterniond>(parameters[2]).toRotationMatrix();
  const Eigen::Vector3d d_C = U.col(1);  // unit direction, see ToPlucker()
  const Eigen::Vector3d d_B = T_B_C.R * d_C;
  const Matrix23d d_r_d_dB = across_ * T_W_B.R;
  Vector2Map{residuals} = d_r_d_dB * d_B;
  if (jacobians == nullptr) return true;

  const Matrix23d d_r_d_dC = d_r_d_dB * T_B_C.R;
  if (jacobians[0]) SetPoseJacobian<2>(Matrix23d::Zero(), -d_r_d_dB * Skew(d_B), jacobians[0]);
  if (jacobians[1]) SetPoseJacobian<2>(Matrix23d::Zero(), -d_r_d_dC * Skew(d_C), jacobians[1]);
  if (jacobians[2]) {
    LineJacobian J(jacobians[2]);
    J.setZero();
    J.leftCols<3>() = -d_r_d_dC * U * Skew(Eigen::Vector3d::UnitY());
  }
  return true;
}

}  // namespace plm_vins

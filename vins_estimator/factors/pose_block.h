// SPDX-License-Identifier: BSD-3-Clause
// Access of the visual factors to poses (factors/manifolds.h) and to their Jacobians.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {

// A pose variable with its rotation as a matrix.
struct PoseBlock {
  explicit PoseBlock(const double* values)
      : p(values), R(Eigen::Map<const Eigen::Quaterniond>(values + 3).toRotationMatrix()) {}

  Eigen::Map<const Eigen::Vector3d> p;
  Eigen::Matrix3d R;
};

// Writes the tangent Jacobian of a two-dimensional residual, padded with a column of zeros.
inline void SetPoseJacobian(const Eigen::Matrix<double, 2, 3>& d_r_d_p,
                            const Eigen::Matrix<double, 2, 3>& d_r_d_theta, double* values) {
  Eigen::Map<Eigen::Matrix<double, 2, kPoseSize, Eigen::RowMajor>> J(values);
  J.leftCols<3>() = d_r_d_p;
  J.middleCols<3>(3) = d_r_d_theta;
  J.col(6).setZero();
}

}  // namespace plm_vins

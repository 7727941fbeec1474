// SPDX-License-Identifier: BSD-3-Clause
// Access of the visual factors to poses (factors/manifolds.h) and to their Jacobians.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {

// A pose variable with its rotation as a matrix.
struct PoseBlock {
  PoseBlock() = default;
  explicit PoseBlock(const double* values)
      : p(Eigen::Map<const Eigen::Vector3d>(values)),
        R(Eigen::Map<const Eigen::Quaterniond>(values + 3).toRotationMatrix()) {}

  Eigen::Vector3d p;
  Eigen::Matrix3d R;
};

// Writes the tangent Jacobian of a residual with kRows rows, padded with a column of zeros.
template <int kRows>
void SetPoseJacobian(const Eigen::Matrix<double, kRows, 3>& d_r_d_p,
                     const Eigen::Matrix<double, kRows, 3>& d_r_d_theta, double* values) {
  Eigen::Map<Eigen::Matrix<double, kRows, kPoseSize, Eigen::RowMajor>> J(values);
  J.template leftCols<3>() = d_r_d_p;
  J.template middleCols<3>(3) = d_r_d_theta;
  J.col(6).setZero();
}

}  // namespace plm_vins

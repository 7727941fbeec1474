// SPDX-License-Identifier: BSD-3-Clause
// The manifold of poses.
//
// A pose is [p_W (3), q_W_B (x, y, z, w)], its tangent [dp (3), dtheta (3)]:
//   p <- p + dp,   q <- q Exp(dtheta)   (rotation perturbed on the right, in the body frame)
//
// Convention for every factor of this project: the Jacobian with respect to a pose is the
// derivative with respect to the tangent of Plus at zero, 6 columns, followed by one column of
// zeros. Its 7 columns are *not* derivatives with respect to the 7 numbers of the pose. The same
// holds for lines (5 -> 4).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plm_vins {

constexpr int kPoseSize = 7;
constexpr int kPoseTangentSize = 6;

// Computes x_plus_delta = x [+] delta. The resulting quaternion has unit norm.
void PosePlus(const double* x, const double* delta, double* x_plus_delta);

// Computes delta such that y = x [+] delta; its rotation angle is at most pi.
void PoseMinus(const double* y, const double* x, double* y_minus_x);

// Access of the visual factors to poses (factors/manifolds.h) and to their Jacobians.

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

// SPDX-License-Identifier: BSD-3-Clause
// Transforms a point from the host's camera to that of another frame, with the derivatives along
// the chain, for the factors that measure it there.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry/so3.h"
#include "vins_estimator/factors/pose_block.h"
#include "vins_estimator/geometry/point_in_host.h"

namespace plm_vins {

using Matrix23d = Eigen::Matrix<double, 2, 3>;

// Returns the derivative of weight * (x / z, y / z) with respect to the point.
inline Matrix23d ProjectionJacobian(const Eigen::Vector3d& p_C, double weight) {
  const Eigen::Vector2d m = p_C.hnormalized();
  Matrix23d J;
  J << 1, 0, -m.x(), 0, 1, -m.y();
  J *= weight / p_C.z();
  return J;
}

// Returns the derivative of PointInHost() with respect to its argument.
inline Eigen::Matrix3d PointInHostJacobian(const double* point) {
  const Eigen::Vector3d p_Ch = PointInHost(point);
  Eigen::Matrix3d J;
  J << 1, 0, -p_Ch.x(), 0, 1, -p_Ch.y(), 0, 0, -p_Ch.z();
  J /= point[2];
  return J;
}

struct PointChain {
  // `poses`: those of host and target (7 each), and the extrinsics T_B_C (7).
  PointChain(double const* const* poses, const double* point_in_host)
      : T_W_Bh(poses[0]),
        T_W_Bt(poses[1]),
        T_B_C(poses[2]),
        point(point_in_host),
        p_Ch(PointInHost(point)),
        p_Bh(T_B_C.R * p_Ch + T_B_C.p),
        p_W(T_W_Bh.R * p_Bh + T_W_Bh.p),
        p_Bt(T_W_Bt.R.transpose() * (p_W - T_W_Bt.p)),
        p_Ct(T_B_C.R.transpose() * (p_Bt - T_B_C.p)) {}

  // Writes the requested Jacobians: with respect to the three poses, and to the point.
  template <int kRows>
  void SetJacobians(const Eigen::Matrix<double, kRows, 3>& d_r_d_pCt, double** jacobians,
                    double* point_jacobian) const {
    using RowsBy3 = Eigen::Matrix<double, kRows, 3>;
    const RowsBy3 d_r_d_pBt = d_r_d_pCt * T_B_C.R.transpose();
    const RowsBy3 d_r_d_pW = d_r_d_pBt * T_W_Bt.R.transpose();
    const RowsBy3 d_r_d_pBh = d_r_d_pW * T_W_Bh.R;
    const RowsBy3 d_r_d_pCh = d_r_d_pBh * T_B_C.R;
    if (jacobians[0]) SetPoseJacobian<kRows>(d_r_d_pW, -d_r_d_pBh * Skew(p_Bh), jacobians[0]);
    if (jacobians[1]) SetPoseJacobian<kRows>(-d_r_d_pW, d_r_d_pBt * Skew(p_Bt), jacobians[1]);
    if (jacobians[2]) {
      SetPoseJacobian<kRows>(d_r_d_pBh - d_r_d_pBt, d_r_d_pCt * Skew(p_Ct) - d_r_d_pCh * Skew(p_Ch),
                             jacobians[2]);
    }
    if (point_jacobian) {
      Eigen::Map<Eigen::Matrix<double, kRows, 3, Eigen::RowMajor>> J(point_jacobian);
      J = d_r_d_pCh * PointInHostJacobian(point);
    }
  }

  PoseBlock T_W_Bh, T_W_Bt, T_B_C;
  const double* point;
  Eigen::Vector3d p_Ch, p_Bh, p_W, p_Bt, p_Ct;
};

}  // namespace plm_vins

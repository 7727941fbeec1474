// SPDX-License-Identifier: BSD-3-Clause
// Transforms a line from the host's camera to that of another frame, with the derivatives along the
// chain, for the factors that measure it there.
#pragma once

#include <Eigen/Core>

#include "common/geometry/so3.h"
#include "vins_estimator/factors/pose_block.h"
#include "vins_estimator/geometry/plucker.h"

namespace plm_vins {

using Matrix23d = Eigen::Matrix<double, 2, 3>;

// Transforms a line from the frame whose pose is given to its parent frame.
inline PluckerLine ToParent(const PoseBlock& pose, const PluckerLine& line) {
  const Eigen::Vector3d direction = pose.R * line.direction;
  return {pose.R * line.moment + pose.p.cross(direction), direction};
}

// Transforms a line from the parent frame to the frame whose pose is given.
inline PluckerLine ToChild(const PoseBlock& pose, const PluckerLine& line) {
  return {pose.R.transpose() * (line.moment - pose.p.cross(line.direction)),
          pose.R.transpose() * line.direction};
}

// Derivatives of a residual with respect to the moment and the direction of a line in one frame.
struct LineDerivative {
  Matrix23d moment, direction;
};

// Convert derivatives with respect to a line in a child frame to those in its parent frame, and the
// reverse.
inline LineDerivative ByParent(const PoseBlock& pose, const LineDerivative& by_child) {
  const Matrix23d moment = by_child.moment * pose.R.transpose();
  return {moment, by_child.direction * pose.R.transpose() - moment * Skew(pose.p)};
}
inline LineDerivative ByChild(const PoseBlock& pose, const LineDerivative& by_parent) {
  return {by_parent.moment * pose.R,
          (by_parent.direction + by_parent.moment * Skew(pose.p)) * pose.R};
}

// Writes the Jacobian with respect to a line's coordinates.
inline void SetLineJacobian(const LineDerivative& derivative, const double* line, double* values) {
  const PluckerJacobian plucker = ToPluckerJacobian(line);
  Eigen::Map<Eigen::Matrix<double, 2, kLineSize, Eigen::RowMajor>> J(values);
  J.leftCols<kLineTangentSize>() =
      derivative.moment * plucker.d_moment + derivative.direction * plucker.d_direction;
  J.rightCols<1>().setZero();
}

struct LineChain {
  // `poses`: those of host and target (7 each), and the extrinsics T_B_C (7).
  LineChain(double const* const* poses, const double* line_in_host)
      : T_W_Bh(poses[0]),
        T_W_Bt(poses[1]),
        T_B_C(poses[2]),
        line(line_in_host),
        L_Ch(ToPlucker(line)),
        L_Bh(ToParent(T_B_C, L_Ch)),
        L_W(ToParent(T_W_Bh, L_Bh)),
        L_Bt(ToChild(T_W_Bt, L_W)),
        L_Ct(ToChild(T_B_C, L_Bt)) {}

  // Writes the requested Jacobians: with respect to the three poses, and to the line.
  void SetJacobians(const LineDerivative& d_r_d_Ct, double** jacobians,
                    double* line_jacobian) const {
    // Chain rule, backwards: derivatives with respect to each frame's moment, then its direction,
    // which changes the moments of the frames further along through the lever arms.
    const LineDerivative d_r_d_Bt = ByParent(T_B_C, d_r_d_Ct);
    const LineDerivative d_r_d_W = ByParent(T_W_Bt, d_r_d_Bt);
    const LineDerivative d_r_d_Bh = ByChild(T_W_Bh, d_r_d_W);
    const LineDerivative d_r_d_Ch = ByChild(T_B_C, d_r_d_Bh);
    if (jacobians[0]) {
      SetPoseJacobian<2>(-d_r_d_W.moment * Skew(L_W.direction), ByRotation(d_r_d_Bh, L_Bh),
                         jacobians[0]);
    }
    if (jacobians[1]) {
      SetPoseJacobian<2>(d_r_d_W.moment * Skew(L_W.direction), -ByRotation(d_r_d_Bt, L_Bt),
                         jacobians[1]);
    }
    if (jacobians[2]) {
      SetPoseJacobian<2>(
          d_r_d_Bt.moment * Skew(L_Bt.direction) - d_r_d_Bh.moment * Skew(L_Bh.direction),
          -ByRotation(d_r_d_Ct, L_Ct) - d_r_d_Ch.moment * Skew(L_Ch.moment) -
              d_r_d_Ch.direction * Skew(L_Ch.direction),
          jacobians[2]);
    }
    if (line_jacobian) SetLineJacobian(d_r_d_Ch, line, line_jacobian);
  }

  PoseBlock T_W_Bh, T_W_Bt, T_B_C;
  const double* line;
  PluckerLine L_Ch, L_Bh, L_W, L_Bt, L_Ct;

 private:
  // Derivative with respect to a rotation of the line's frame, theta in R Exp(theta).
  static Matrix23d ByRotation(const LineDerivative& derivative, const PluckerLine& line) {
    return -derivative.moment * Skew(line.moment) - derivative.direction * Skew(line.direction);
  }
};

}  // namespace plm_vins

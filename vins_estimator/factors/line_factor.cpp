// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/line_factor.h"

#include <Eigen/Geometry>

#include "common/geometry/so3.h"
#include "vins_estimator/factors/pose_block.h"

namespace plm_vins {
namespace {

using Matrix23d = Eigen::Matrix<double, 2, 3>;
using Vector2Map = Eigen::Map<Eigen::Vector2d>;
using LineJacobian = Eigen::Map<Eigen::Matrix<double, 2, kLineSize, Eigen::RowMajor>>;

// Transforms a line from the frame whose pose is given to its parent frame.
PluckerLine ToParent(const PoseBlock& pose, const PluckerLine& line) {
  const Eigen::Vector3d direction = pose.R * line.direction;
  return {pose.R * line.moment + pose.p.cross(direction), direction};
}

// Transforms a line from the parent frame to the frame whose pose is given.
PluckerLine ToChild(const PoseBlock& pose, const PluckerLine& line) {
  return {pose.R.transpose() * (line.moment - pose.p.cross(line.direction)),
          pose.R.transpose() * line.direction};
}

void SetLineJacobian(const Matrix23d& d_r_d_moment, const Matrix23d& d_r_d_direction,
                     const double* line, double* values) {
  const PluckerJacobian plucker = ToPluckerJacobian(line);
  LineJacobian J(values);
  J.leftCols<kLineTangentSize>() =
      d_r_d_moment * plucker.d_moment + d_r_d_direction * plucker.d_direction;
  J.rightCols<1>().setZero();
}

}  // namespace

bool LineFactor::EvaluateWithNormal(double const* const* parameters, double* residuals,
                                    double** jacobians, Eigen::Vector2d* normal) const {
  const PoseBlock T_W_Bh(parameters[0]), T_W_Bt(parameters[1]), T_B_C(parameters[2]);
  const PluckerLine L_Ch = ToPlucker(parameters[3]);
  const PluckerLine L_Bh = ToParent(T_B_C, L_Ch);
  const PluckerLine L_W = ToParent(T_W_Bh, L_Bh);
  const PluckerLine L_Bt = ToChild(T_W_Bt, L_W);
  const PluckerLine L_Ct = ToChild(T_B_C, L_Bt);

  Eigen::Vector2d distances;
  Matrix23d d_r_d_mCt;
  if (!EndPointDistances(view_, L_Ct.moment, &distances, &d_r_d_mCt)) return false;
  Vector2Map{residuals} = weight_ * distances;
  if (normal != nullptr) *normal = L_Ct.moment.head<2>().normalized();
  if (jacobians == nullptr) return true;

  // Chain rule, backwards: derivatives with respect to each frame's moment, then its direction,
  // which changes the moments of the frames further along through the lever arms.
  d_r_d_mCt *= weight_;
  const Matrix23d d_r_d_mBt = d_r_d_mCt * T_B_C.R.transpose();
  const Matrix23d d_r_d_vBt = -d_r_d_mBt * Skew(T_B_C.p);
  const Matrix23d d_r_d_mW = d_r_d_mBt * T_W_Bt.R.transpose();
  const Matrix23d d_r_d_vW = d_r_d_vBt * T_W_Bt.R.transpose() - d_r_d_mW * Skew(T_W_Bt.p);
  const Matrix23d d_r_d_mBh = d_r_d_mW * T_W_Bh.R;
  const Matrix23d d_r_d_vBh = (d_r_d_vW + d_r_d_mW * Skew(T_W_Bh.p)) * T_W_Bh.R;
  const Matrix23d d_r_d_mCh = d_r_d_mBh * T_B_C.R;
  const Matrix23d d_r_d_vCh = (d_r_d_vBh + d_r_d_mBh * Skew(T_B_C.p)) * T_B_C.R;

  if (jacobians[0]) {
    SetPoseJacobian(-d_r_d_mW * Skew(L_W.direction),
                    -d_r_d_mBh * Skew(L_Bh.moment) - d_r_d_vBh * Skew(L_Bh.direction),
                    jacobians[0]);
  }
  if (jacobians[1]) {
    SetPoseJacobian(d_r_d_mW * Skew(L_W.direction),
                    d_r_d_mBt * Skew(L_Bt.moment) + d_r_d_vBt * Skew(L_Bt.direction), jacobians[1]);
  }
  if (jacobians[2]) {
    SetPoseJacobian(d_r_d_mBt * Skew(L_Bt.direction) - d_r_d_mBh * Skew(L_Bh.direction),
                    d_r_d_mCt * Skew(L_Ct.moment) - d_r_d_mCh * Skew(L_Ch.moment) -
                        d_r_d_vCh * Skew(L_Ch.direction),
                    jacobians[2]);
  }
  if (jacobians[3]) SetLineJacobian(d_r_d_mCh, d_r_d_vCh, parameters[3], jacobians[3]);
  return true;
}

bool LineHostFactor::EvaluateWithNormal(double const* const* parameters, double* residuals,
                                        double** jacobians, Eigen::Vector2d* normal) const {
  Eigen::Vector2d distances;
  Matrix23d d_r_d_moment;
  const PluckerLine line = ToPlucker(parameters[0]);
  if (!EndPointDistances(view_, line.moment, &distances, &d_r_d_moment)) return false;
  Vector2Map{residuals} = weight_ * distances;
  if (normal != nullptr) *normal = line.moment.head<2>().normalized();
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  SetLineJacobian(weight_ * d_r_d_moment, Matrix23d::Zero(), parameters[0], jacobians[0]);
  return true;
}

}  // namespace plm_vins

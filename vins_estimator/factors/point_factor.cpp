// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/point_factor.h"

#include <Eigen/Geometry>

#include "common/geometry/so3.h"
#include "vins_estimator/factors/pose_block.h"
#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {
namespace {

using Matrix23d = Eigen::Matrix<double, 2, 3>;
using Vector2Map = Eigen::Map<Eigen::Vector2d>;

}  // namespace

bool PointFactor::Evaluate(double const* const* parameters, double* residuals,
                           double** jacobians) const {
  const PoseBlock T_W_Bh(parameters[0]), T_W_Bt(parameters[1]), T_B_C(parameters[2]);
  const double td = parameters[3][0];

  const Eigen::Vector3d p_Ch = PointInHost(parameters[4]);
  const Eigen::Vector3d p_Bh = T_B_C.R * p_Ch + T_B_C.p;
  const Eigen::Vector3d p_W = T_W_Bh.R * p_Bh + T_W_Bh.p;
  const Eigen::Vector3d p_Bt = T_W_Bt.R.transpose() * (p_W - T_W_Bt.p);
  const Eigen::Vector3d p_Ct = T_B_C.R.transpose() * (p_Bt - T_B_C.p);
  if (!(p_Ct.z() > kMinProjectedDepth)) return false;

  const Eigen::Vector2d m_t = p_Ct.hnormalized();
  Vector2Map{residuals} = weight_ * (m_t - target_.At(td));
  if (jacobians == nullptr) return true;

  Matrix23d d_r_d_pCt;
  d_r_d_pCt << 1, 0, -m_t.x(), 0, 1, -m_t.y();
  d_r_d_pCt *= weight_ / p_Ct.z();
  const Matrix23d d_r_d_pBt = d_r_d_pCt * T_B_C.R.transpose();
  const Matrix23d d_r_d_pW = d_r_d_pBt * T_W_Bt.R.transpose();
  const Matrix23d d_r_d_pBh = d_r_d_pW * T_W_Bh.R;
  const Matrix23d d_r_d_pCh = d_r_d_pBh * T_B_C.R;

  if (jacobians[0]) SetPoseJacobian(d_r_d_pW, -d_r_d_pBh * Skew(p_Bh), jacobians[0]);
  if (jacobians[1]) SetPoseJacobian(-d_r_d_pW, d_r_d_pBt * Skew(p_Bt), jacobians[1]);
  if (jacobians[2]) {
    SetPoseJacobian(d_r_d_pBh - d_r_d_pBt, d_r_d_pCt * Skew(p_Ct) - d_r_d_pCh * Skew(p_Ch),
                    jacobians[2]);
  }
  if (jacobians[3]) Vector2Map{jacobians[3]} = weight_ * target_.velocity;
  if (jacobians[4]) {
    Eigen::Matrix3d d_pCh_d_point;
    d_pCh_d_point << 1, 0, -p_Ch.x(), 0, 1, -p_Ch.y(), 0, 0, -p_Ch.z();
    d_pCh_d_point /= parameters[4][2];
    Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>{jacobians[4]} =
        d_r_d_pCh * d_pCh_d_point;
  }
  return true;
}

bool PointHostFactor::Evaluate(double const* const* parameters, double* residuals,
                               double** jacobians) const {
  const double td = parameters[0][0];
  const double* point = parameters[1];
  Vector2Map{residuals} = weight_ * (Eigen::Vector2d(point[0], point[1]) - host_.At(td));
  if (jacobians == nullptr) return true;
  if (jacobians[0]) Vector2Map{jacobians[0]} = weight_ * host_.velocity;
  if (jacobians[1]) {
    Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>> J(jacobians[1]);
    J << weight_, 0, 0, 0, weight_, 0;
  }
  return true;
}

}  // namespace plm_vins

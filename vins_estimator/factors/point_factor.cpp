// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/point_factor.h"

#include "vins_estimator/factors/point_chain.h"
#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {
namespace {

using Vector2Map = Eigen::Map<Eigen::Vector2d>;

}  // namespace

bool PointFactor::Evaluate(double const* const* parameters, double* residuals,
                           double** jacobians) const {
  const PointChain chain(parameters, parameters[4]);
  if (!(chain.p_Ct.z() > kMinProjectedDepth)) return false;
  const double td = parameters[3][0];
  Vector2Map{residuals} = weight_ * (chain.p_Ct.hnormalized() - target_.At(td));
  if (jacobians == nullptr) return true;
  chain.SetJacobians<2>(ProjectionJacobian(chain.p_Ct, weight_), jacobians, jacobians[4]);
  if (jacobians[3]) Vector2Map{jacobians[3]} = weight_ * target_.velocity;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/line_factor.h"

#include "vins_estimator/factors/line_chain.h"

namespace plm_vins {
namespace {

using Vector2Map = Eigen::Map<Eigen::Vector2d>;

}  // namespace

bool LineFactor::EvaluateWithNormal(double const* const* parameters, double* residuals,
                                    double** jacobians, Eigen::Vector2d* normal) const {
  const LineChain chain(parameters, parameters[3]);
  const Eigen::Vector3d& moment = chain.L_Ct.moment;
  Eigen::Vector2d distances;
  Matrix23d d_r_d_mCt;
  if (!EndPointDistances(view_, moment, &distances, &d_r_d_mCt)) return false;
  Vector2Map{residuals} = weight_ * distances;
  if (normal != nullptr) *normal = moment.head<2>().normalized();
  if (jacobians == nullptr) return true;
  chain.SetJacobians({weight_ * d_r_d_mCt, Matrix23d::Zero()}, jacobians, jacobians[3]);
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
  SetLineJacobian({weight_ * d_r_d_moment, Matrix23d::Zero()}, parameters[0], jacobians[0]);
  return true;
}

}  // namespace plm_vins

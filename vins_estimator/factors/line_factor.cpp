// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/line_factor.h"

namespace plm_vins {

bool LineFactor::EvaluateWithNormal(double const* const* parameters, double* residuals,
                                    double** jacobians, Eigen::Vector2d* normal) const {
  const int line_block = kind_.CountBlocks();
  const double* line = parameters[line_block];
  const LineChain chain(kind_, parameters, ToPlucker(line));
  const Eigen::Vector3d& moment = chain.in_target().moment;
  Eigen::Vector2d distances;
  Eigen::Matrix<double, 2, 3> d_r_d_moment;
  if (!EndPointDistances(segment_, moment, &distances, &d_r_d_moment)) return false;
  Eigen::Map<Eigen::Vector2d>{residuals} = weights_.cwiseProduct(distances);
  if (normal != nullptr) *normal = moment.head<2>().normalized();
  if (jacobians == nullptr) return true;
  const LineDerivative by_target{weights_.asDiagonal() * d_r_d_moment,
                                 Eigen::Matrix<double, 2, 3>::Zero()};
  const LineDerivative by_host = chain.SetJacobians<2>(by_target, jacobians);
  if (jacobians[line_block]) SetLineJacobian(by_host, line, jacobians[line_block]);
  return true;
}

}  // namespace plm_vins

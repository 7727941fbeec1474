// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/depth_factor.h"

#include <cmath>

#include "vins_estimator/factors/point_chain.h"
#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {

bool DepthFactor::Evaluate(double const* const* parameters, double* residuals,
                           double** jacobians) const {
  const int stream_block = kind_.CountBlocks(), point_block = stream_block + 1;
  const double *stream = parameters[stream_block], *point = parameters[point_block];
  const PointChain chain(kind_, parameters, PointInHost(point));
  const double z = chain.in_target().z(), inverse = 1 / z;
  if (!(z > kMinProjectedDepth)) return false;
  const double expected = depth_.Expected(inverse, stream);
  residuals[0] = weight_ * (expected - 1 / depth_.depth);
  if (jacobians == nullptr) return true;
  const double scale = std::exp(-stream[0]);
  const double by_inverse = scale * (1 - 2 * stream[1] * depth_.approach * inverse);
  const auto by_host = chain.SetJacobians<1>(
      PointDerivative<1>(0, 0, -weight_ * by_inverse * inverse * inverse), jacobians);
  if (double* jacobian = jacobians[stream_block]) {
    Eigen::Map<Eigen::Matrix<double, 1, kDepthStreamSize>>{jacobian} =
        weight_ * depth_.ByStream(inverse, stream);
  }
  if (jacobians[point_block]) SetPointJacobian<1>(by_host, point, jacobians[point_block]);
  return true;
}

}  // namespace plm_vins

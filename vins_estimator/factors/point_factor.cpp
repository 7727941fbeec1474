// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/point_factor.h"

#include <cmath>

#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {
namespace {

using Vector2Map = Eigen::Map<Eigen::Vector2d>;

// Without a chain, the observation is compared with the point's own coordinates.
void EvaluateInHost(const Eigen::Vector2d& observed, double weight, const double* point,
                    double* residuals, double* point_jacobian) {
  Vector2Map{residuals} = weight * (Eigen::Vector2d(point[0], point[1]) - observed);
  if (point_jacobian == nullptr) return;
  Eigen::Map<Eigen::Matrix<double, 2, kPointSize, Eigen::RowMajor>> J(point_jacobian);
  J << weight, 0, 0, 0, weight, 0;
}

}  // namespace

bool PointFactor::Evaluate(double const* const* parameters, double* residuals,
                           double** jacobians) const {
  const int td_block = kind_.CountBlocks(), point_block = td_block + 1;
  const double* point = parameters[point_block];
  const Eigen::Vector2d observed = target_.At(parameters[td_block][0]);
  double* const td_jacobian = jacobians ? jacobians[td_block] : nullptr;
  double* const point_jacobian = jacobians ? jacobians[point_block] : nullptr;
  if (td_jacobian) Vector2Map{td_jacobian} = weight_ * target_.velocity;
  if (kind_.is_host()) {
    EvaluateInHost(observed, weight_, point, residuals, point_jacobian);
    return true;
  }
  const PointChain chain(kind_, parameters, PointInHost(point));
  const Eigen::Vector3d& p_Ct = chain.in_target();
  if (!(p_Ct.z() > kMinProjectedDepth)) return false;
  Vector2Map{residuals} = weight_ * (p_Ct.hnormalized() - observed);
  if (jacobians == nullptr) return true;
  const auto by_host = chain.SetJacobians<2>(ProjectionJacobian(p_Ct, weight_), jacobians);
  if (point_jacobian) SetPointJacobian<2>(by_host, point, point_jacobian);
  return true;
}

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

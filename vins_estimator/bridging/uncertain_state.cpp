// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/bridging/uncertain_state.h"

#include <Eigen/LU>
#include <cmath>

#include "vins_estimator/factors/imu_factor.h"

namespace plm_vins {
namespace {

// Lazy products take a compiler far less time.
Matrix15d Propagated(const Matrix15d& J, const Matrix15d& covariance) {
  const Matrix15d half = J.lazyProduct(covariance);
  return half.lazyProduct(J.transpose());
}

}  // namespace

// The residual between the two states is the noise n of the interval; linearized, J_0 dx_0 + J_1
// dx_1 = n.
UncertainState Propagate(const UncertainState& start, const Preintegration& motion,
                         const Eigen::Vector3d& gravity_W) {
  const FrameState end = motion.Predict(start.state, gravity_W);
  ImuResidualJacobians jacobians;
  ImuResidual(motion, gravity_W, start.state, end, &jacobians);
  const Matrix15d J_0 = jacobians.ByFirst();
  const Matrix15d d_end_d_noise = jacobians.BySecond().inverse();
  const Matrix15d noise = Propagated(J_0, start.covariance) + motion.Covariance();
  return {end, Propagated(d_end_d_noise, noise)};
}

double PositionDeviation(const UncertainState& estimate) {
  return std::sqrt(estimate.covariance.diagonal().segment<3>(ImuErrorIndex::kPosition).maxCoeff());
}

double HeadingDeviation(const UncertainState& estimate) {
  const Eigen::Vector3d up_B = estimate.state.rotation().conjugate() * Eigen::Vector3d::UnitZ();
  constexpr int kRotation = ImuErrorIndex::kRotation;
  return std::sqrt(up_B.dot(estimate.covariance.block<3, 3>(kRotation, kRotation) * up_B));
}

}  // namespace plm_vins

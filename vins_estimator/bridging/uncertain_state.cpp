// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/bridging/uncertain_state.h"

#include <Eigen/LU>
#include <cmath>

#include "vins_estimator/factors/imu_factor.h"

namespace plm_vins {

// The residual between the two states is the noise n of the interval; linearized, J_0 dx_0 + J_1
// dx_1 = n.
UncertainState Propagate(const UncertainState& start, const Preintegration& motion,
                         const Eigen::Vector3d& gravity_W) {
  const FrameState end = motion.Predict(start.state, gravity_W);
  ImuResidualJacobians jacobians;
  ImuResidual(motion, gravity_W, start.state, end, &jacobians);
  const Matrix15d J_0 = jacobians.ByFirst();
  const Matrix15d d_end_d_noise = jacobians.BySecond().inverse();
  return {end, d_end_d_noise * (J_0 * start.covariance * J_0.transpose() + motion.Covariance()) *
                   d_end_d_noise.transpose()};
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

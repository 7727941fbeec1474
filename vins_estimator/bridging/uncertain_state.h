// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// A state with its covariance in the tangent space: (p_W, rotation in B, v_W, accelerometer bias,
// gyroscope bias).
struct UncertainState {
  FrameState state;
  Matrix15d covariance;
};

// Propagates a state and its covariance over the interval of `motion`, adding the IMU noise.
UncertainState Propagate(const UncertainState& start, const Preintegration& motion,
                         const Eigen::Vector3d& gravity_W);

double PositionDeviation(const UncertainState& estimate);  // along the least certain axis [m]
double HeadingDeviation(const UncertainState& estimate);   // [rad]

}  // namespace plm_vins

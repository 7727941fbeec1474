// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// A state with its covariance in the tangents of pose and motion: (p_W, rotation in B, v_W,
// accelerometer bias, gyro bias).
struct UncertainState {
  FrameState state;
  Matrix15d covariance = Matrix15d::Zero();
};

// The state at the end of the interval; the noise of the IMU adds to its covariance.
UncertainState Propagate(const UncertainState& start, const Preintegration& motion,
                         const Eigen::Vector3d& gravity_W);

double PositionDeviation(const UncertainState& estimate);  // of the axis known worst [m]
double HeadingDeviation(const UncertainState& estimate);   // [rad]

}  // namespace plm_vins

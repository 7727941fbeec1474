// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/normal_equations.h"

namespace plm_vins {

// Covariance of the newest state where only the states after a keyframe were solved for
// (PlacementProblem), by the covariance of the keyframe's state and by `equations` at
// their last linearisation. An error of the keyframe moves the landmarks with it, as a rigid body,
// and the IMU carries it on; it is taken into account, but not estimated ([Schmidt1966]). Zero
// where the equations do not determine the states.
Matrix15d PlacedCovariance(const SlidingWindow& window, int64_t keyframe_ns,
                           const Matrix15d& keyframe_covariance, NormalEquations* equations);

}  // namespace plm_vins

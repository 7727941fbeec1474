// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/sensor_config.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/marginalization_prior.h"
#include "vins_estimator/problem/problem_options.h"

namespace plm_vins {

// Standard deviations of the first state of a window.
struct InitialUncertainty {
  double position = 1e-3;     // the world's origin is where the body is: fixed by definition [m]
  double heading = 1e-3;      // so is its heading [rad]
  double inclination = 0.03;  // roll and pitch [rad]
  double velocity = 0.3;      // [m/s]
  double accel_bias = 0.1;    // [m/s^2]
  double gyro_bias = 0.02;    // [rad/s]
  double extrinsic_position = 0.02;  // [m]
  double extrinsic_rotation = 0.02;  // [rad]
  double td = 0.01;                  // [s]
  double readout = 0.01;             // [s]
  IntrinsicsDeviation intrinsics;
};

// The prior of a new window: its first frame is where it was put, and the calibration about right.
MarginalizationPrior InitialPrior(const InitialUncertainty& uncertainty,
                                  const ProblemOptions& options, const SlidingWindow& window);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/config/sensor_config.h"
#include "vins_estimator/equations/marginalization_prior.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/problem_options.h"

namespace plm_vins {

// Standard deviations of the first state of a window.
struct InitialUncertainty {
  double position = 1e-3;     // fixes the gauge: the world's origin is the initial position [m]
  double heading = 1e-3;      // fixes the gauge [rad]
  double inclination = 0.03;  // roll and pitch [rad]
  double velocity = 0.3;      // [m/s]
  double accel_bias = SensorConfig().accel_bias_deviation;  // about 0 [m/s^2]
  double gyro_bias = 0.02;                                  // [rad/s]
  // If set, roll and pitch come from the mean specific force at standstill, whose standard
  // deviation this is [m/s^2]; `inclination` is then not used.
  std::optional<double> leveled_by = std::nullopt;
  double extrinsic_position = 0.02;           // of the first camera [m]
  double extrinsic_rotation = 0.02;           // of the first camera [rad]
  double td = 0.01;                           // [s]
  double depth_scale = kDepthScaleDeviation;  // relative
  double depth_delay = 0.02;                  // [s]
  double depth_shift = 0.01;                  // normalized
  double depth_zoom = 0.02;                   // relative
  IntrinsicsDeviation intrinsics;
};

// Returns the prior of a new window: on its first frame's state and on the calibration.
MarginalizationPrior InitialPrior(const InitialUncertainty& uncertainty,
                                  const ProblemOptions& options, const SlidingWindow& window);

}  // namespace plm_vins

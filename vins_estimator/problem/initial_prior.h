// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>

#include "common/config/sensor_config.h"
#include "vins_estimator/least_squares/marginalization_prior.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/problem_options.h"

namespace plm_vins {

// Relative standard deviation of the lengths that a calibrated stereo camera, or depth sensor,
// measures: of the baseline, or of depths.
constexpr double kLengthDeviation = 0.002;

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
  double extrinsic_position = 0.02;  // [m]
  double extrinsic_rotation = 0.02;  // [rad]
  double mounting =
      0.05 * M_PI / 180;  // rotation of the second camera, direction of the baseline [rad]
  double baseline = kLengthDeviation;     // relative standard deviation of its length
  double td = 0.01;                       // [s]
  double depth_scale = kLengthDeviation;  // relative
  double depth_delay = 0.01;              // [s]
  IntrinsicsDeviation intrinsics;
};

// Returns the prior of a new window: on its first frame's state and on the calibration.
MarginalizationPrior InitialPrior(const InitialUncertainty& uncertainty,
                                  const ProblemOptions& options, const SlidingWindow& window);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/measurements.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

struct MotionInitializerOptions {
  double min_parallax_sigmas = 4;  // median over the points of the best pair, in standard
                                   // deviations of a corner
  // Relative, of the adjusted states. If propellers cause vibration, the estimated uncertainty is
  // half the true one.
  double max_scale_deviation = 0.1;
  double max_reprojection_rms = 2;  // in standard deviations of a corner
  double max_imu_rms = 3;           // in standard deviations of the preintegrated measurements
  double max_accel_bias = 1.0;      // [m/s^2]
  double max_gyro_bias = 0.5;       // [rad/s]
  int camera = 0;                   // whose points alone are used, unless `stereo`
  // Uses overlapping cameras or measured depth: needs neither parallax nor acceleration.
  bool stereo = false;
};

// Initializes the states of a few images in motion from their points and IMU samples alone:
// gyroscope bias from relative poses, structure up to scale, alignment (velocities,
// gravity, scale), visual-inertial bundle adjustment, checks. With overlapping
// cameras, relative poses and structure are those of stereo odometry, and the scale is known.
// `frames[i + 1].imu` is from frame i to frame i + 1; `frames[0].imu` is not used. World:
// origin and zero heading at the first frame. Returns nullopt, with the reason, if a step
// or check fails.
std::optional<std::vector<FrameState>> InitializeFromMotion(
    const std::vector<FrameMeasurement>& frames, const SensorConfig& sensor, double point_noise_px,
    const MotionInitializerOptions& options, std::string* reason);

}  // namespace plm_vins

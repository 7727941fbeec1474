// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Noise of an IMU as continuous-time densities, equal on all axes (as Kalibr and data sheets give
// them).
struct ImuNoise {
  double gyro_density = 1.7e-4;   // [rad/s/sqrt(Hz)]
  double accel_density = 2.0e-3;  // [m/s^2/sqrt(Hz)]
  double gyro_walk = 2.0e-5;      // bias random walk [rad/s^2/sqrt(Hz)]
  double accel_walk = 3.0e-3;     // bias random walk [m/s^3/sqrt(Hz)]
};

}  // namespace plm_vins

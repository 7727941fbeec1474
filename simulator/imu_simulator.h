// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/imu/imu_noise.h"
#include "common/imu/imu_sensor.h"
#include "common/measurements.h"
#include "simulator/trajectory.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins::simulator {

struct ImuSimulationOptions {
  ImuSensor sensor;            // its corrections are undone in the samples
  ImuNoise noise;              // white noise densities and bias random walks
  bool add_noise = true;       // false: no noise and constant biases
  double gravity_norm = 9.81;  // [m/s^2], along -z of W
  double rate_hz = 200.0;
  int64_t start_ns = 0;  // timestamp of the trajectory's start
  ImuBias initial_bias;
  uint64_t seed = 1;
};

struct ImuSimulation {
  std::vector<ImuSample> samples;  // from the start to the end of the trajectory
  std::vector<ImuBias> biases;     // true biases, one for each sample

  // True biases at the last sample up to `t_ns`, or at the first sample if `t_ns` is earlier.
  const ImuBias& BiasAt(int64_t t_ns) const;
};

// Samples an ideal strapdown IMU along the trajectory and adds biases and noise: gyro = omega_B +
// b_g + n_g, accel = R_B_W (a_W + (0, 0, g)) + b_a + n_a, both before the corrections are undone.
ImuSimulation SimulateImu(const Trajectory& trajectory, const ImuSimulationOptions& options);

// Combines the true state of the body with timestamp and biases.
FrameState TrueState(int64_t t_ns, const BodyState& body, const ImuBias& bias);

}  // namespace plm_vins::simulator

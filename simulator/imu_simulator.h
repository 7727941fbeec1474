// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "simulator/trajectory.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins::simulator {

struct ImuSimulationOptions {
  ImuNoise noise;              // densities of white noise and bias walks
  bool add_noise = true;       // false: neither noise nor bias walk; the initial biases stay
  double gravity_norm = 9.81;  // [m/s^2], along -z of W
  double rate_hz = 200.0;
  int64_t start_ns = 0;  // stamp of the trajectory's start
  ImuBias initial_bias;
  uint64_t seed = 1;
};

struct ImuSimulation {
  std::vector<ImuSample> samples;  // from the trajectory's start to its end
  std::vector<ImuBias> biases;     // true biases, one for each sample

  // True biases at the last sample not after `t_ns` (the first sample's before that).
  const ImuBias& BiasAt(int64_t t_ns) const;
};

// Samples an ideal strapdown IMU on the trajectory, then adds biases and noise:
// gyro = omega_B + b_g + n_g, accel = R_B_W (a_W + (0, 0, g)) + b_a + n_a.
ImuSimulation SimulateImu(const Trajectory& trajectory, const ImuSimulationOptions& options);

// The true state of the body, stamped `t_ns`.
FrameState TrueState(int64_t t_ns, const BodyState& body, const ImuBias& bias);

}  // namespace plm_vins::simulator

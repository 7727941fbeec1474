// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/imu_simulator.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

Trajectory MakeTrajectory(Motion motion, double duration) {
  TrajectoryOptions options;
  options.motion = motion;
  options.duration = duration;
  return Trajectory(options);
}

ImuSimulationOptions NoiseFree(double rate_hz) {
  ImuSimulationOptions options;
  options.add_noise = false;
  options.rate_hz = rate_hz;
  return options;
}

TEST(ImuSimulator, NoiseHasTheRequestedDensity) {
  ImuSimulationOptions options;
  options.noise.gyro_walk = options.noise.accel_walk = 0;
  options.initial_bias = {Vector3d(0.1, -0.2, 0.3), Vector3d(0.01, 0.02, -0.03)};
  const auto imu = SimulateImu(MakeTrajectory(Motion::kStill, 100.0), options);
  Vector3d gyro_squared = Vector3d::Zero(), accel_squared = Vector3d::Zero();
  for (const ImuSample& sample : imu.samples) {
    gyro_squared += (sample.gyro - options.initial_bias.gyro).cwiseAbs2();
    accel_squared += (sample.accel - options.initial_bias.accel - Vector3d(0, 0, 9.81)).cwiseAbs2();
  }
  const double count = static_cast<double>(imu.samples.size());
  for (int axis = 0; axis < 3; ++axis) {  // 20000 samples: 0.5 % standard deviation
    EXPECT_NEAR(std::sqrt(gyro_squared[axis] / count / 200) / options.noise.gyro_density, 1, 0.02);
    EXPECT_NEAR(std::sqrt(accel_squared[axis] / count / 200) / options.noise.accel_density, 1,
                0.02);
  }
}

TEST(ImuSimulator, BiasesWalkWithTheRequestedDensity) {
  ImuSimulationOptions options;
  const auto imu = SimulateImu(MakeTrajectory(Motion::kStill, 100.0), options);
  Vector3d gyro_squared = Vector3d::Zero(), accel_squared = Vector3d::Zero();
  for (size_t i = 1; i < imu.biases.size(); ++i) {
    gyro_squared += (imu.biases[i].gyro - imu.biases[i - 1].gyro).cwiseAbs2();
    accel_squared += (imu.biases[i].accel - imu.biases[i - 1].accel).cwiseAbs2();
  }
  const double duration = 100.0;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(gyro_squared[axis] / duration) / options.noise.gyro_walk, 1, 0.02);
    EXPECT_NEAR(std::sqrt(accel_squared[axis] / duration) / options.noise.accel_walk, 1, 0.02);
  }
  EXPECT_EQ(imu.BiasAt(-1).gyro, imu.biases.front().gyro);
  EXPECT_EQ(imu.BiasAt(7'000'000).gyro, imu.biases[1].gyro);
}

TEST(ImuSimulator, ConfiguredCorrectionsRestoreTheReadings) {
  ImuSimulationOptions options = NoiseFree(200.0);
  options.initial_bias = {Vector3d(0.1, -0.2, 0.3), Vector3d(0.01, 0.02, -0.03)};
  const Trajectory trajectory = MakeTrajectory(Motion::kFast, 4.0);
  const auto ideal = SimulateImu(trajectory, options);
  options.sensor.gyro_correction << 0, -0.98, 0, 1.02, 0.01, 0, 0, 0, 1;
  options.sensor.accel_correction << 1.05, 0, 0, 0, 1, 0, 0, 0.02, 0.95;
  const auto distorted = SimulateImu(trajectory, options);
  for (size_t i = 0; i < ideal.samples.size(); ++i) {
    const ImuSample corrected = Corrected(distorted.samples[i], options.sensor);
    EXPECT_LT((corrected.gyro - ideal.samples[i].gyro).norm(), 1e-12);
    EXPECT_LT((corrected.accel - ideal.samples[i].accel).norm(), 1e-12);
  }
  EXPECT_GT((distorted.samples[0].accel - ideal.samples[0].accel).norm(), 0.3);
}

}  // namespace
}  // namespace plm_vins::simulator

// SPDX-License-Identifier: BSD-3-Clause
#include "test/vins_estimator/simulated_window.h"

#include <memory>
#include <vector>

#include "common/config/config.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins::testing {

ProblemOptions OnePixelOptions() {
  Config config;
  config.sensor.cameras[0].parameters = simulator::DefaultSensors().cameras[0].parameters;
  config.estimator.point_noise = config.estimator.line_noise = 1;
  return {config, kSimulatedFocalLength};
}

SimulatedWindow SimulateWindow(simulator::FeatureSimulationOptions options, size_t frame_count,
                               size_t stride) {
  options.trajectory.duration = 3.5 + static_cast<double>(frame_count * stride) / 20.0;
  const SimulatedFlight flight = SimulateFlight(options, /*skip=*/3);
  constexpr double kLineNoise = 1 / kSimulatedFocalLength;
  SimulatedWindow result(LocalMapOptions(kLineNoise, /*remember_lines=*/true));
  SlidingWindow& window = result.window;
  window.cameras[0].SetExtrinsics(flight.sensor.cameras[0].T_B_C);
  window.cameras[0].intrinsics = window.cameras[0].ray_intrinsics =
      flight.sensor.cameras[0].parameters.intrinsics();
  std::vector<ImuSample> imu;
  for (size_t i = 0; i <= (frame_count - 1) * stride; ++i) {
    JoinImu(flight.frames[i].imu, &imu);
    if (i % stride != 0) continue;
    WindowFrame frame;
    frame.state = flight.truth[i];
    if (i > 0) {
      frame.motion_since_previous =
          std::make_shared<Preintegration>(flight.sensor.imu_noise, window.newest().state.bias());
      for (const ImuSample& sample : imu) frame.motion_since_previous->Append(sample);
    }
    imu = {flight.frames[i].imu.back()};
    result.AddFrame(frame, flight.frames[i].points, flight.frames[i].lines);
  }
  result.points.Triangulate(window, /*min_angle=*/0.02);
  result.lines.Triangulate(window, LineLimits(kLineNoise, /*max_length=*/10));
  return result;
}

SimulatedWindow SimulateWindow(size_t frame_count, uint64_t seed, size_t stride, int max_points) {
  simulator::FeatureSimulationOptions options = FlightOptions(simulator::Motion::kFast, seed);
  options.max_points = max_points;
  return SimulateWindow(options, frame_count, stride);
}

SimulatedWindow SimulateShakenWindow(uint64_t seed) {
  simulator::FeatureSimulationOptions options = FlightOptions(simulator::Motion::kFast, seed);
  options.max_points = 80;
  options.sensors.imu_noise.accel_density = 0.1;
  options.sensors.imu_noise.gyro_density = 5e-3;
  return SimulateWindow(options, 7, 5);
}

void ScaleAssumedNoise(double variance_scale, SlidingWindow* window) {
  for (WindowFrame& frame : window->frames) {
    const auto& motion = frame.motion_since_previous;
    if (motion) motion->Reweigh(Scaled(motion->noise(), variance_scale));
  }
}

Eigen::VectorXd NormalVector(Eigen::Index size, simulator::Random* random) {
  Eigen::VectorXd result(size);
  for (Eigen::Index i = 0; i < size; ++i) result[i] = random->Normal();
  return result;
}

void Disturb(double scale, simulator::Random* random, FrameState* state) {
  const Eigen::VectorXd delta = scale * NormalVector(6, random);
  PosePlus(state->pose.data(), delta.data(), state->pose.data());
  state->velocity() += scale * random->NormalVector3();
  state->accel_bias() += 0.1 * scale * random->NormalVector3();
  state->gyro_bias() += 0.1 * scale * random->NormalVector3();
}

void Disturb(double scale, simulator::Random* random, SlidingWindow* window) {
  for (WindowFrame& frame : window->frames) Disturb(scale, random, &frame.state);
  for (AnchorFrame& anchor : window->anchors) Disturb(scale, random, &anchor.state);
}
}  // namespace plm_vins::testing

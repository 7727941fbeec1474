// SPDX-License-Identifier: BSD-3-Clause
#include "test/vins_estimator/initialization/simulated_frames.h"

#include <Eigen/Geometry>
#include <cmath>

namespace plm_vins::testing {

SimulatedFlight WithoutLines(SimulatedFlight flight) {
  for (FrameMeasurement& frame : flight.frames) frame.lines.reset();
  return flight;
}

SimulatedFlight ToFlight(const simulator::FeatureDataset& data, const SensorConfig& sensor,
                         double skip) {
  MeasurementSync::Options sync_options;
  sync_options.max_frames = static_cast<int>(data.points.size());
  MeasurementSync sync(sync_options);
  for (const ImuSample& sample : data.imu) sync.AddImu(sample);
  for (const PointFrame& points : data.points) sync.AddPoints(points);
  for (const LineFrame& lines : data.lines) sync.AddLines(lines);
  SimulatedFlight flight;
  flight.sensor = sensor;
  while (const auto frame = sync.Flush()) {
    if (ToSeconds(frame->t_ns - data.points.front().t_ns) < skip) continue;
    flight.frames.push_back(*frame);
  }
  for (const FrameState& state : data.truth) {
    if (state.t_ns >= flight.frames.front().t_ns) flight.truth.push_back(state);
  }
  flight.truth.resize(flight.frames.size());
  return flight;
}

SimulatedFlight SimulateFlight(const simulator::FeatureSimulationOptions& options, double skip) {
  return ToFlight(simulator::SimulateFeatures(options), options.sensors, skip);
}

simulator::FeatureSimulationOptions FlightOptions(simulator::Motion motion, uint64_t seed) {
  simulator::FeatureSimulationOptions options;
  options.trajectory.motion = motion;
  options.trajectory.seed = seed;
  options.trajectory.rest = 0;
  options.trajectory.lead_in = 0.5;
  options.trajectory.duration = 8;
  options.initial_bias.gyro = Eigen::Vector3d(-0.003, 0.021, 0.078);
  options.initial_bias.accel = Eigen::Vector3d(-0.025, 0.08, 0.04);
  options.seed = seed;
  return options;
}

double SizeOf(const std::vector<Eigen::Vector3d>& positions) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : positions) mean += p / positions.size();
  double sum = 0;
  for (const Eigen::Vector3d& p : positions) sum += (p - mean).squaredNorm();
  return std::sqrt(sum / positions.size());
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double GravityError(const FrameState& a, const FrameState& b) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  return AngleBetween(a.rotation().conjugate() * z, b.rotation().conjugate() * z);
}

double VelocityError(const FrameState& a, const FrameState& b) {
  const Eigen::Vector3d v_a = a.rotation().conjugate() * a.velocity();
  const Eigen::Vector3d v_b = b.rotation().conjugate() * b.velocity();
  return (v_a - v_b).norm();
}
}  // namespace plm_vins::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "test/vins_estimator/estimated_flight.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry/so3.h"

namespace plm_vins::testing {

Config ConfigFor(const SimulatedFlight& flight) {
  Config config;
  config.sensor = flight.sensor;
  config.estimator.point_noise = simulator::FeatureSimulationOptions().point_noise_px;
  return config;
}

EstimatedFlight Estimate(const SimulatedFlight& flight, Estimator* estimator) {
  EstimatedFlight result;
  for (size_t i = 0; i < flight.frames.size(); ++i) {
    const EstimatorOutput output = estimator->Process(flight.frames[i]);
    if (output.restarted) result.restarts.push_back(output.reason);
    if (!output.has_pose) continue;
    if (!result.truth.empty()) {
      result.path += (flight.truth[i].position() - result.truth.back().position()).norm();
    }
    if (result.truth.empty()) {
      result.anchor = output.window.front();
      result.true_anchor =
          *std::find_if(flight.truth.begin(), flight.truth.end(),
                        [&](const FrameState& state) { return state.t_ns == result.anchor.t_ns; });
    }
    result.outputs.push_back(output);
    result.truth.push_back(flight.truth[i]);
  }
  return result;
}

EstimatedFlight Estimate(const SimulatedFlight& flight) {
  Estimator estimator(ConfigFor(flight));
  return Estimate(flight, &estimator);
}

double AbsoluteError(const EstimatedFlight& flight) {
  const Eigen::Index count = static_cast<Eigen::Index>(flight.truth.size());
  Eigen::Matrix3Xd estimate(3, count), truth(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    estimate.col(i) = flight.outputs[i].state.position();
    truth.col(i) = flight.truth[i].position();
  }
  const Eigen::Matrix4d T = Eigen::umeyama(estimate, truth, /*with_scaling=*/false);
  const Eigen::Matrix3Xd aligned = (T * estimate.colwise().homogeneous()).topRows<3>();
  return std::sqrt((aligned - truth).squaredNorm() / static_cast<double>(count));
}

Rigid3d AlignHeading(const FrameState& estimate, const FrameState& truth) {
  const Eigen::Matrix3d difference =
      (truth.rotation() * estimate.rotation().conjugate()).toRotationMatrix();
  const double heading =
      std::atan2(difference(1, 0) - difference(0, 1), difference(0, 0) + difference(1, 1));
  const Eigen::Quaterniond R(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
  return {R, truth.position() - R * estimate.position()};
}

double ErrorAt(const EstimatedFlight& flight, size_t aligned_at, size_t index) {
  const Rigid3d T = AlignHeading(flight.outputs[aligned_at].state, flight.truth[aligned_at]);
  const Eigen::Vector3d p = T * Eigen::Vector3d(flight.outputs[index].state.position());
  return (p - flight.truth[index].position()).norm();
}

double GreatestError(const EstimatedFlight& flight, size_t aligned_at) {
  double greatest = 0;
  for (size_t i = aligned_at; i < flight.truth.size(); ++i) {
    greatest = std::max(greatest, ErrorAt(flight, aligned_at, i));
  }
  return greatest;
}

Consistency MeasureConsistencyAt(const EstimatedFlight& flight, size_t index) {
  const Rigid3d T = AlignHeading(flight.anchor, flight.true_anchor);
  const EstimatorOutput& output = flight.outputs[index];
  const FrameState& true_state = flight.truth[index];
  const Rigid3d truth = T.Inverse() * true_state.T_W_B();
  Eigen::Matrix<double, 6, 1> pose, biases;
  pose << truth.translation - output.state.position(),
      SO3Log(output.state.rotation().conjugate() * truth.rotation);
  const Eigen::Vector3d velocity =
      T.rotation.conjugate() * true_state.velocity() - output.state.velocity();
  biases << true_state.bias().accel - output.state.bias().accel,
      true_state.bias().gyro - output.state.bias().gyro;
  const StateUncertainty& known = output.uncertainty.value();
  return {pose.dot(known.pose.ldlt().solve(pose)),
          velocity.dot(known.velocity.ldlt().solve(velocity)),
          biases.dot(known.biases.ldlt().solve(biases))};
}

Consistency MeasureConsistency(const EstimatedFlight& flight) {
  Consistency mean;
  const double share = 1.0 / static_cast<double>(flight.truth.size());
  for (size_t i = 0; i < flight.truth.size(); ++i) {
    const Consistency consistency = MeasureConsistencyAt(flight, i);
    mean.pose += share * consistency.pose;
    mean.velocity += share * consistency.velocity;
    mean.biases += share * consistency.biases;
  }
  return mean;
}
}  // namespace plm_vins::testing

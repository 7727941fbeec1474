// SPDX-License-Identifier: BSD-3-Clause
// Runs the estimator on simulated flights and measures its errors.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/geometry/so3.h"
#include "test/vins_estimator/initialization/simulated_frames.h"
#include "vins_estimator/estimator.h"

namespace plm_vins::testing {

inline Config ConfigFor(const SimulatedFlight& flight) {
  Config config;
  config.sensor = flight.sensor;
  config.estimator.point_noise = simulator::FeatureSimulationOptions().point_noise_px;
  return config;
}

struct EstimatedFlight {
  std::vector<EstimatorOutput> outputs;  // for images with a pose
  std::vector<FrameState> truth;         // for the same images
  FrameState anchor, true_anchor;        // oldest state of the first window
  std::vector<std::string> restarts;     // their reasons
  double path = 0;                       // length of the true path [m]
};

inline EstimatedFlight Estimate(const SimulatedFlight& flight, Estimator* estimator) {
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

inline EstimatedFlight Estimate(const SimulatedFlight& flight) {
  Estimator estimator(ConfigFor(flight));
  return Estimate(flight, &estimator);
}

// Root mean square distance of the positions after rigid alignment [m].
inline double AbsoluteError(const EstimatedFlight& flight) {
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

// Transform of the estimate's world to the true one that aligns position and heading of one state.
inline Rigid3d AlignHeading(const FrameState& estimate, const FrameState& truth) {
  const Eigen::Matrix3d difference =
      (truth.rotation() * estimate.rotation().conjugate()).toRotationMatrix();
  const double heading =
      std::atan2(difference(1, 0) - difference(0, 1), difference(0, 0) + difference(1, 1));
  const Eigen::Quaterniond R(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
  return {R, truth.position() - R * estimate.position()};
}

// Position error of an image after alignment at another image [m].
inline double ErrorAt(const EstimatedFlight& flight, size_t aligned_at, size_t index) {
  const Rigid3d T = AlignHeading(flight.outputs[aligned_at].state, flight.truth[aligned_at]);
  const Eigen::Vector3d p = T * Eigen::Vector3d(flight.outputs[index].state.position());
  return (p - flight.truth[index].position()).norm();
}

// Largest position error from the alignment on [m].
inline double GreatestError(const EstimatedFlight& flight, size_t aligned_at) {
  double greatest = 0;
  for (size_t i = aligned_at; i < flight.truth.size(); ++i) {
    greatest = std::max(greatest, ErrorAt(flight, aligned_at, i));
  }
  return greatest;
}

// Throws std::bad_optional_access if the covariance is unknown.
inline const Matrix6d& PoseCovariance(const EstimatorOutput& output) {
  return output.uncertainty.value().pose;
}

// NEES of pose, velocity and biases: on average 6, 3 and 6 with consistent covariances.
struct Consistency {
  double pose = 0, velocity = 0, biases = 0;
};

inline Consistency MeasureConsistencyAt(const EstimatedFlight& flight, size_t index) {
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

// Means over a flight.
inline Consistency MeasureConsistency(const EstimatedFlight& flight) {
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

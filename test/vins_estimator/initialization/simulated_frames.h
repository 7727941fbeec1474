// SPDX-License-Identifier: BSD-3-Clause
// Simulated flights as input of the estimator, for tests of initialization.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "test/feature_simulator/feature_simulator.h"
#include "vins_estimator/input/measurement_sync.h"

namespace plm_vins::testing {

struct SimulatedFlight {
  SensorConfig sensor;
  std::vector<FrameMeasurement> frames;
  std::vector<FrameState> truth;  // one for each frame
};

// Removes the lines, as with a point tracker only.
SimulatedFlight WithoutLines(SimulatedFlight flight);

// Converts a simulation to estimator input, from `skip` seconds after the start on.
SimulatedFlight ToFlight(const simulator::FeatureDataset& data, const SensorConfig& sensor,
                         double skip = 0);

// Simulates a flight from `skip` seconds after the start on, so that it can begin in motion.
SimulatedFlight SimulateFlight(const simulator::FeatureSimulationOptions& options, double skip = 0);

// A flight with biases similar to EuRoC's and without standstill.
simulator::FeatureSimulationOptions FlightOptions(simulator::Motion motion, uint64_t seed);

// Size of a set of positions: root mean square distance from their mean [m].
double SizeOf(const std::vector<Eigen::Vector3d>& positions);

// Angle between two directions [rad].
double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// Angle between the gravity directions of two states in the body frame [rad].
double GravityError(const FrameState& a, const FrameState& b);

// Difference of the velocities in the body frame, which is independent of the heading [m/s].
double VelocityError(const FrameState& a, const FrameState& b);

}  // namespace plm_vins::testing

// SPDX-License-Identifier: BSD-3-Clause
// Runs the estimator on simulated flights and measures its errors.
#pragma once

#include <string>
#include <vector>

#include "test/vins_estimator/initialization/simulated_frames.h"
#include "vins_estimator/estimator.h"

namespace plm_vins::testing {

Config ConfigFor(const SimulatedFlight& flight);

struct EstimatedFlight {
  std::vector<EstimatorOutput> outputs;  // for images with a pose
  std::vector<FrameState> truth;         // for the same images
  FrameState anchor, true_anchor;        // oldest state of the first window
  std::vector<std::string> restarts;     // their reasons
  double path = 0;                       // length of the true path [m]
};

EstimatedFlight Estimate(const SimulatedFlight& flight, Estimator* estimator);

EstimatedFlight Estimate(const SimulatedFlight& flight);

// Root mean square distance of the positions after rigid alignment [m].
double AbsoluteError(const EstimatedFlight& flight);

// Transform of the estimate's world to the true one that aligns position and heading of one state.
Rigid3d AlignHeading(const FrameState& estimate, const FrameState& truth);

// Position error of an image after alignment at another image [m].
double ErrorAt(const EstimatedFlight& flight, size_t aligned_at, size_t index);

// Largest position error from the alignment on [m].
double GreatestError(const EstimatedFlight& flight, size_t aligned_at);

// Throws std::bad_optional_access if the covariance is unknown.
inline const Matrix6d& PoseCovariance(const EstimatorOutput& output) {
  return output.uncertainty.value().pose;
}

// NEES of pose, velocity and biases: on average 6, 3 and 6 with consistent covariances.
struct Consistency {
  double pose = 0, velocity = 0, biases = 0;
};

Consistency MeasureConsistencyAt(const EstimatedFlight& flight, size_t index);

// Means over a flight.
Consistency MeasureConsistency(const EstimatedFlight& flight);

}  // namespace plm_vins::testing

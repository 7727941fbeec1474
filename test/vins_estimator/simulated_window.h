// SPDX-License-Identifier: BSD-3-Clause
// A sliding window in mid-flight with known ground truth, for tests of optimization and
// marginalization.
#pragma once

#include <Eigen/Core>

#include "simulator/random.h"
#include "test/vins_estimator/initialization/simulated_frames.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/problem/problem_options.h"

namespace plm_vins::testing {

constexpr double kSimulatedFocalLength = 460;  // [px]

// Corners and lines with a standard deviation of one pixel; fixed calibration.
ProblemOptions OnePixelOptions();

// The states are the true ones; landmarks are triangulated from them.
using SimulatedWindow = LocalMap;

// Returns `frame_count` keyframes of a flight, `stride` images (at 20 Hz) apart.
SimulatedWindow SimulateWindow(simulator::FeatureSimulationOptions options, size_t frame_count,
                               size_t stride);

// Simulates a fast flight with up to `max_points` tracked corners.
SimulatedWindow SimulateWindow(size_t frame_count, uint64_t seed = 1, size_t stride = 5,
                               int max_points = 25);

// Simulates strong IMU noise as from propellers, which is observable from the corners of any
// window.
SimulatedWindow SimulateShakenWindow(uint64_t seed);

// Scales the IMU noise variance that all intervals assume.
void ScaleAssumedNoise(double variance_scale, SlidingWindow* window);

Eigen::VectorXd NormalVector(Eigen::Index size, simulator::Random* random);

// Adds normal noise to the state: [m], [rad], [m/s] times `scale`; a tenth of it to the biases.
void Disturb(double scale, simulator::Random* random, FrameState* state);

void Disturb(double scale, simulator::Random* random, SlidingWindow* window);

}  // namespace plm_vins::testing

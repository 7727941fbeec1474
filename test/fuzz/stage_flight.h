// SPDX-License-Identifier: BSD-3-Clause
// Runs the estimation stage on a simulated flight, with a limit on the time for each image.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <utility>

#include "common/features/feature_checks.h"
#include "test/feature_simulator/feature_simulator.h"
#include "vins_estimator/estimation_stage.h"

namespace plm_vins::fuzz {

inline simulator::FeatureDataset SimulateFastFlight(double seconds) {
  simulator::FeatureSimulationOptions options;
  options.trajectory.motion = simulator::Motion::kFast;
  options.trajectory.rest = 0;
  options.trajectory.lead_in = 0.5;
  options.trajectory.duration = seconds;
  options.max_points = 130;
  options.max_lines = 8;
  return simulator::SimulateFeatures(options);
}

inline void CheckFrame(const EstimatedFrame& frame, double milliseconds) {
  constexpr double kMaxFrame_ms = 1000;  // CPU time, including sanitizers
  const FrameState& state = frame.output.state;
  const bool finite = state.position().allFinite() && state.velocity().allFinite() &&
                      state.rotation().coeffs().allFinite() &&
                      (!frame.output.uncertainty || frame.output.uncertainty->pose.allFinite());
  if (frame.output.has_pose && !finite) {
    std::fprintf(stderr, "stage: a pose is not finite\n");
    std::abort();
  }
  if (milliseconds > kMaxFrame_ms) {
    std::fprintf(stderr, "stage: a frame took %.0f ms\n", milliseconds);
    std::abort();
  }
}

// Removes duplicate ids and implausible coordinates, as the conversion of messages does.
inline PointFrame Converted(PointFrame frame) {
  RemoveImpossible(&frame.points);
  return frame;
}

inline void Fly(const simulator::FeatureDataset& flight,
                const std::function<void(const EstimatorOutput&)>& on_output) {
  Config config;
  config.sensor = simulator::FeatureSimulationOptions().sensors;
  EstimationStage stage(config);
  size_t sample = 0;
  for (size_t i = 0; i < flight.points.size(); ++i) {
    stage.AddPoints(Converted(flight.points[i]));
    stage.AddLines(flight.lines[i]);
    for (size_t end = (i + 1) * flight.imu.size() / flight.points.size(); sample < end; ++sample) {
      if (IsStamp(flight.imu[sample].t_ns)) stage.AddImu(flight.imu[sample]);
    }
    std::clock_t begin = std::clock();
    while (const auto frame = stage.Pop()) {
      CheckFrame(*frame, 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
      on_output(frame->output);
      begin = std::clock();
    }
  }
}

}  // namespace plm_vins::fuzz

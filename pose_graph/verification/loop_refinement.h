// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>

#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/verification/loop_observations.h"

namespace plm_vins {

struct LoopRefinementOptions {
  static constexpr double kPointNoise_px = 2;
  static constexpr double kLineNoise_px = 1.5;

  explicit LoopRefinementOptions(double focal_length)  // [px]
      : point_noise(kPointNoise_px / focal_length), line_noise(kLineNoise_px / focal_length) {}

  double point_noise;              // noise of a corner matched across visits (normalized)
  double depth_noise = 0.05;       // error of a landmark along its ray, relative to its distance
  double line_noise;               // noise of an endpoint perpendicular to the line (normalized)
  double tilt = 0.2 * M_PI / 180;  // standard deviation of roll and pitch between the visits
  // Standard deviations added to those of the result, for errors that all landmarks have in common.
  double floor_position = 0.02;          // [m]
  double floor_yaw = 0.06 * M_PI / 180;  // [rad]
};

struct RefinedLoop {
  LevelTransform T_O1_O2;
  Matrix4d covariance;  // covariance of the later position and heading, as in LevelEdge
};

// Minimizes the robust residuals of all observations from `start`. Returns nullopt if the solver
// fails.
std::optional<RefinedLoop> RefineLoop(const LoopRefinementOptions& options,
                                      const LoopObservations& observations,
                                      const LevelTransform& start);

}  // namespace plm_vins

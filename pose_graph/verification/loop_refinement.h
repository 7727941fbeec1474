// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>

#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/verification/loop_sightings.h"

namespace plm_vins {

struct LoopRefinementOptions {
  static constexpr double kPointNoise_px = 2;
  static constexpr double kLineNoise_px = 1.5;

  explicit LoopRefinementOptions(double focal_length)  // [px]
      : point_noise(kPointNoise_px / focal_length), line_noise(kLineNoise_px / focal_length) {}

  double point_noise;              // (normalised) of a corner that another patch of the place gave
  double depth_noise = 0.05;       // of a landmark along its ray, share of its distance
  double line_noise;               // (normalised) of an end across the line
  double tilt = 0.2 * M_PI / 180;  // by which roll and pitch of one visit err against the other's
  // Of the result, on top of what the sightings say: what landmarks have wrong in common.
  double floor_position = 0.02;          // [m]
  double floor_yaw = 0.06 * M_PI / 180;  // [rad]
};

struct RefinedLoop {
  LevelTransform T_O1_O2;
  Matrix4d covariance;  // of the later visit's place and heading, with the axes of O1, as LevelEdge
                        // has it
};

// The transform that fits all sightings best, from `start`; robust against some that are wrong.
// Nothing where the solver fails.
std::optional<RefinedLoop> RefineLoop(const LoopRefinementOptions& options,
                                      const LoopSightings& sightings, const LevelTransform& start);

}  // namespace plm_vins

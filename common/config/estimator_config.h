// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config_key.h"

namespace plm_vins {

// Solver of the window optimization; see docs/solver.md.
enum class SolverType { kSchur, kCeres };

struct EstimatorConfig {
  int window_size = 16;             // keyframes in the window, in addition to the newest frame
  double keyframe_parallax = 20.0;  // mean parallax that makes a keyframe [px]
  int max_num_iterations = 8;       // maximum iterations of the window optimization
  SolverType solver = SolverType::kSchur;
  double point_noise = 0.7;     // standard deviation of a corner [px]
  double line_noise = 0.5;      // standard deviation of an endpoint across the line [px]
  bool adapt_noise = true;      // adapt both to the residuals
  bool adapt_imu_noise = true;  // increase IMU noise to match the residuals

  double line_outlier_distance = 10.0;     // longest accepted line [m]
  bool line_merging = true;                // merge landmarks of the same line
  double line_merge_distance = 0.1;        // between lines that are merged, in space [m]
  double line_merge_image_distance = 5.0;  // between lines that are merged, in the image [px]
  int line_anchors = 24;                   // frames kept as anchors for recognized lines
  bool manhattan_constraints = true;       // lines along a Manhattan axis constrain the heading

  bool zero_velocity_update = true;
};

ConfigKeys EstimatorKeys(EstimatorConfig* estimator);

}  // namespace plm_vins

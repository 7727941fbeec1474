// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config_key.h"

namespace plm_vins {

// Of the window; see docs/solver.md.
enum class SolverType { kSchur, kCeres };

struct EstimatorConfig {
  int window_size = 12;             // keyframes kept beside the newest frame
  double keyframe_parallax = 20.0;  // mean parallax that makes a keyframe [px]
  int max_num_iterations = 8;       // of the window optimisation
  SolverType solver = SolverType::kSchur;
  double point_noise = 0.7;     // standard deviation of a corner [px]
  double line_noise = 0.5;      // standard deviation of a line's end across the line [px]
  bool adapt_noise = true;      // let both follow what the images show
  bool adapt_imu_noise = true;  // let that of the IMU grow to what the images show

  double line_outlier_distance = 10.0;     // longest line that is believed [m]
  bool line_merging = true;                // one landmark for what is one line
  double line_merge_distance = 0.1;        // between lines that are merged, in space [m]
  double line_merge_image_distance = 5.0;  // the same, in the image [px]
  double line_merge_angle = 3.0;           // between their directions [deg]
  int line_anchors = 24;                   // frames kept for the sake of lines that come back
  bool manhattan_constraints = true;       // lines on a Manhattan axis hold the heading
  double manhattan_noise = 1.0;            // of a line's direction from its axis [deg]

  bool zero_velocity_update = true;
  bool verbose = false;
};

ConfigKeys<EstimatorConfig> EstimatorKeys();

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.h"
#include "vins_estimator/map/keyframe_policy.h"
#include "vins_estimator/map/line_comparison.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/recall/anchor_policy.h"
#include "vins_estimator/solver/levenberg_marquardt.h"

namespace plm_vins {

// The configuration, converted to the options and units of each part of the estimator: image
// distances and noise are divided by the focal length.
struct EstimatorOptions {
  explicit EstimatorOptions(const Config& config);

  double focal_length;  // [px]
  LocalMapOptions map;
  KeyframePolicyOptions keyframes;
  double min_triangulation_angle;  // between the rays of a point [rad]
  double unnoticed_turn_rate;      // error of the gyro bias after a standstill [rad/s]
  double max_reprojection_error;   // mean reprojection error of a point, normalized
  double max_inverse_depth_error;  // error of a measured inverse depth [1/m]
  double max_ray_error;            // error of rays when the intrinsics are refined, normalized
  double max_motion_at_rest_px;    // common corner motion at standstill, if the depth is known [px]
  double passing_flow;             // the same limit, as a velocity [1/s], normalized
  LineLimits line_limits;
  SameLineLimits same_line;
  AnchorPolicyOptions anchors;
  ProblemOptions problem;
  SolverOptions newest_solution;  // for the states after the newest keyframe only
  SolverOptions first_solution;   // for the window that was just initialized
  // Used while the window fills: the scale is hardly observable and strongly nonlinear at first.
  SolverOptions early_solution;
  SolverOptions solution;

 private:
  EstimatorOptions(const Config& config, double focal_length);  // [px]
};

// Returns the initial uncertainty of the first window.
InitialUncertainty UncertaintyOf(const SensorConfig& sensor, bool from_standstill);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.h"
#include "vins_estimator/map/keyframe_policy.h"
#include "vins_estimator/map/line_comparison.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/optimization/levenberg_marquardt.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/recall/anchor_policy.h"

namespace plm_vins {

// What the configuration asks of each part of the estimator, in the part's own units: image
// distances and noise divided by the focal length.
struct EstimatorOptions {
  explicit EstimatorOptions(const Config& config);

  LocalMapOptions map;
  KeyframePolicyOptions keyframes;
  double min_triangulation_angle;  // between the rays of a point [rad]
  double max_reprojection_error;   // of a point, mean over its views, normalised
  double max_ray_error;            // of rays by intrinsics that were refined since, normalised
  double max_motion_at_rest_px;    // in common to corners, where points are known that tell it [px]
  double passing_flow;             // by which these may go on at that [1/s], normalised
  LineLimits line_limits;
  SameLineLimits same_line;
  AnchorPolicyOptions anchors;
  ProblemOptions problem;
  SolverOptions newest_solution;  // of the states after the newest keyframe alone
  SolverOptions first_solution;   // of the window that was just initialised
  // While the window fills: the first frames hardly tell the scale, which is far from linear.
  SolverOptions early_solution;
  SolverOptions solution;

 private:
  EstimatorOptions(const Config& config, double focal_length);  // [px]
};

// Of the first window.
InitialUncertainty UncertaintyOf(const SensorConfig& sensor, bool from_standstill);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/estimator_config.h"

namespace plm_vins {

ConfigKeys<EstimatorConfig> EstimatorKeys() {
  using Key = ConfigKey<EstimatorConfig>;
  using E = EstimatorConfig;
  return {
      Key::Integer("window_size", "keyframes", {4, 50}, &E::window_size),
      Key::Number("keyframe_parallax", "px", {0.1, 200}, &E::keyframe_parallax),
      Key::Integer("max_num_iterations", "", {1, 100}, &E::max_num_iterations),
      Key::Choice<SolverType>(
          "solver", {{"schur", SolverType::kSchur}, {"ceres", SolverType::kCeres}}, &E::solver),
      Key::Number("point_noise", "px", {0.01, 20}, &E::point_noise),
      Key::Number("line_noise", "px", {0.01, 20}, &E::line_noise),
      Key::Flag("adapt_noise", &E::adapt_noise),
      Key::Flag("adapt_imu_noise", &E::adapt_imu_noise),
      Key::Number("line_outlier_distance", "m", {0.1, 1000}, &E::line_outlier_distance),
      Key::Flag("line_merging", &E::line_merging),
      Key::Number("line_merge_distance", "m", {0.001, 10}, &E::line_merge_distance),
      Key::Number("line_merge_image_distance", "px", {0.1, 100}, &E::line_merge_image_distance),
      Key::Number("line_merge_angle", "deg", {0.1, 45}, &E::line_merge_angle),
      Key::Integer("line_anchors", "", {0, 100}, &E::line_anchors),
      Key::Flag("manhattan_constraints", &E::manhattan_constraints),
      Key::Number("manhattan_noise", "deg", {0.01, 20}, &E::manhattan_noise),
      Key::Flag("zero_velocity_update", &E::zero_velocity_update),
      Key::Flag("verbose", &E::verbose),
  };
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/estimator_config.h"

namespace plm_vins {

ConfigKeys EstimatorKeys(EstimatorConfig* estimator) {
  using Key = ConfigKey;
  return {
      Key::Integer("window_size", "keyframes", {4, 50}, &estimator->window_size),
      Key::Number("keyframe_parallax", "px", {0.1, 200}, &estimator->keyframe_parallax),
      Key::Integer("max_num_iterations", "", {1, 100}, &estimator->max_num_iterations),
      Key::Choice<SolverType>("solver",
                              {{"schur", SolverType::kSchur}, {"ceres", SolverType::kCeres}},
                              &estimator->solver),
      Key::Number("point_noise", "px", {0.01, 20}, &estimator->point_noise),
      Key::Number("line_noise", "px", {0.01, 20}, &estimator->line_noise),
      Key::Flag("adapt_noise", &estimator->adapt_noise),
      Key::Flag("adapt_imu_noise", &estimator->adapt_imu_noise),
      Key::Number("line_outlier_distance", "m", {0.1, 1000}, &estimator->line_outlier_distance),
      Key::Flag("line_merging", &estimator->line_merging),
      Key::Number("line_merge_distance", "m", {0.001, 10}, &estimator->line_merge_distance),
      Key::Number("line_merge_image_distance", "px", {0.1, 100},
                  &estimator->line_merge_image_distance),
      Key::Integer("line_anchors", "", {0, 100}, &estimator->line_anchors),
      Key::Flag("manhattan_constraints", &estimator->manhattan_constraints),
      Key::Flag("zero_velocity_update", &estimator->zero_velocity_update),
  };
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/verification/seen_point.h"

namespace plm_vins {

// The poses from which two points are seen along two rays, where gravity is known: up to two
// T_O_G, G having the camera's place and z up. `ray_G` have any length. [Kukelova2010] by other
// means: the rays' lengths from one linear equation (heights) and one quadratic (distance).
std::vector<LevelTransform> SolveTwoPoints(const Eigen::Vector3d& ray1_G,
                                           const Eigen::Vector3d& p1_O,
                                           const Eigen::Vector3d& ray2_G,
                                           const Eigen::Vector3d& p2_O);

struct LevelPoseRansacOptions {
  static constexpr double kMaxError_px = 4;

  explicit LevelPoseRansacOptions(double focal_length)  // [px]
      : max_error(kMaxError_px / focal_length) {}

  double max_error;  // of an inlier (normalised)
  int max_iterations = 400;
  double confidence = 0.999;
};

struct LevelPose {
  LevelTransform T_O_G;
  std::vector<size_t> inliers;
};

// The pose that most sightings agree on. Nothing from fewer than two, or where none agree. The
// same input gives the same result.
std::optional<LevelPose> FindLevelPose(const LevelPoseRansacOptions& options,
                                       const std::vector<SeenPoint>& sightings,
                                       const Eigen::Quaterniond& R_G_C);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/verification/loop_observations.h"

namespace plm_vins {

// Computes the camera poses from two points and their rays with known gravity: up to two solutions
// T_O_G, where G has the camera's position and z up. `ray_G` may have any length. This solves the
// problem of [Kukelova2010] differently: the ray lengths follow from a linear equation (heights)
// and a quadratic one (distance).
std::vector<LevelTransform> SolveTwoPoints(const Eigen::Vector3d& ray1_G,
                                           const Eigen::Vector3d& p1_O,
                                           const Eigen::Vector3d& ray2_G,
                                           const Eigen::Vector3d& p2_O);

struct LevelPoseRansacOptions {
  static constexpr double kMaxError_px = 4;

  explicit LevelPoseRansacOptions(double focal_length)  // [px]
      : max_error(kMaxError_px / focal_length) {}

  double max_error;  // reprojection error of an inlier (normalized)
  int max_iterations = 400;
  double confidence = 0.999;
};

struct LevelPose {
  LevelTransform T_O_G;
  std::vector<size_t> inliers;
};

// Returns the pose with the most inliers, or nullopt if there are fewer than two observations or no
// consensus. Deterministic.
std::optional<LevelPose> FindLevelPose(const LevelPoseRansacOptions& options,
                                       const std::vector<SeenPoint>& observations,
                                       const Eigen::Quaterniond& R_G_C);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/geometry/rigid3.h"
#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

// A point in space and where it is seen.
struct SeenPoint {
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();   // normalised
};

// The poses from which two points are seen along two rays, where gravity is known: up to two
// T_O_G, G having the camera's place and z up. `ray_G` have any length. [Kukelova2010] by other
// means: the rays' lengths from one linear equation (heights) and one quadratic (distance).
std::vector<LevelTransform> SolveTwoPoints(const Eigen::Vector3d& ray1_G,
                                           const Eigen::Vector3d& p1_O,
                                           const Eigen::Vector3d& ray2_G,
                                           const Eigen::Vector3d& p2_O);

struct LevelPoseRansacOptions {
  explicit LevelPoseRansacOptions(double focal_length) : max_error(4 / focal_length) {}  // [px]

  double max_error;  // of an inlier (normalised)
  int max_iterations = 400;
  double confidence = 0.999;
};

struct LevelPose {
  LevelTransform T_O_G;
  std::vector<size_t> inliers;
};

// Error of a sighting from a pose (normalised); infinite behind the camera. `R_G_C` is level.
double SightingError(const SeenPoint& sighting, const LevelTransform& T_O_G,
                     const Eigen::Quaterniond& R_G_C);

// The pose that most sightings agree on. Nothing from fewer than two, or where none agree. The
// same input gives the same result.
std::optional<LevelPose> FindLevelPose(const LevelPoseRansacOptions& options,
                                       const std::vector<SeenPoint>& sightings,
                                       const Eigen::Quaterniond& R_G_C);

}  // namespace plm_vins

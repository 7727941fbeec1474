// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

// A point in space and where it is seen.
struct SeenPoint {
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();   // normalised
};

// Error of a sighting from a pose (normalised); infinite behind the camera. `R_G_C` is level.
double SightingError(const SeenPoint& sighting, const LevelTransform& T_O_G,
                     const Eigen::Quaterniond& R_G_C);

}  // namespace plm_vins

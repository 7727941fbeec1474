// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// A camera that sees a point: its pose and the normalised image point.
struct PointSighting {
  Rigid3d T_W_C;
  Eigen::Vector2d xy;
};

// The point p_W that all sightings agree on best: least distance to the rays, then refined on the
// image errors. Nothing where no ray forms an angle of at least `min_angle` [rad] with the first
// one, or where the point is not in front of all cameras.
std::optional<Eigen::Vector3d> TriangulatePoint(const std::vector<PointSighting>& sightings,
                                                double min_angle);

}  // namespace plm_vins

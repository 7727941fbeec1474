// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// Observation of a point: pose of the camera and normalized image point.
struct PosedPointObservation {
  Rigid3d T_W_C;
  Eigen::Vector2d xy;
};

// Triangulates p_W: the point nearest to all rays, refined on the reprojection errors. Returns
// nullopt if no ray forms an angle of at least `min_angle` [rad] with the first one, or if the
// point is behind a camera.
std::optional<Eigen::Vector3d> TriangulatePoint(
    const std::vector<PosedPointObservation>& observations, double min_angle);

}  // namespace plm_vins

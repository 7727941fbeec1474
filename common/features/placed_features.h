// SPDX-License-Identifier: BSD-3-Clause
// Features of an image with their 3-D positions, as passed from odometry to mapping.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// A tracked corner with its position in the odometry's world O, if triangulated.
struct TrackedCorner {
  PointObservation observation;
  std::optional<Eigen::Vector3d> p_O;  // [m]
};

// A 3-D line segment in O, by its two endpoints.
struct SpaceSegment {
  Eigen::Vector3d start_O = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d end_O = Eigen::Vector3d::Zero();    // [m]
};

// A tracked line with its position, if triangulated.
struct TrackedSegment {
  LineObservation observation;
  std::optional<SpaceSegment> landmark;
};

}  // namespace plm_vins

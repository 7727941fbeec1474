// SPDX-License-Identifier: BSD-3-Clause
// Features of an image with their places in space: what odometry hands on to who builds maps.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// A corner that is followed, and its place in the odometry's world O where that is known.
struct TrackedCorner {
  PointObservation observation;
  std::optional<Eigen::Vector3d> p_O;  // [m]
};

// A piece of a straight line in O, by its two ends.
struct SpaceSegment {
  Eigen::Vector3d start_O = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d end_O = Eigen::Vector3d::Zero();    // [m]
};

// A line that is followed, and its place where that is known.
struct TrackedSegment {
  LineObservation observation;
  std::optional<SpaceSegment> landmark;
};

}  // namespace plm_vins

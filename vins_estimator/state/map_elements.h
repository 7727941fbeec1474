// SPDX-License-Identifier: BSD-3-Clause
// Landmarks as the estimator outputs them.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "vins_estimator/state/line_axis.h"

namespace plm_vins {

// A point landmark in the world.
struct MapPoint {
  int64_t id = -1;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  // [m]
};

// A line landmark in the world, reduced to the observed segment.
struct MapLine {
  int64_t id = -1;
  Eigen::Vector3d start_W = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d end_W = Eigen::Vector3d::Zero();    // [m]
  LineAxis axis = LineAxis::kFree;                    // parallel axis of the Manhattan frame
};

}  // namespace plm_vins

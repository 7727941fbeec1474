// SPDX-License-Identifier: BSD-3-Clause
// What the estimator says of its landmarks.
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

// A line landmark in the world, cut to the part that was seen.
struct MapLine {
  int64_t id = -1;
  Eigen::Vector3d start_W = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d end_W = Eigen::Vector3d::Zero();    // [m]
  LineAxis axis = LineAxis::kFree;                    // of the Manhattan frame, that it runs along
};

}  // namespace plm_vins

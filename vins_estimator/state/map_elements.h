// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <stdexcept>

namespace plm_vins {

// Axis of the Manhattan frame M that a line is parallel to; kFree if none.
enum class LineAxis { kFree, kX, kY, kZ };

// Returns the unit vector in M; not defined for kFree.
inline Eigen::Vector3d UnitVector(LineAxis axis) {
  switch (axis) {
    case LineAxis::kX:
      return Eigen::Vector3d::UnitX();
    case LineAxis::kY:
      return Eigen::Vector3d::UnitY();
    case LineAxis::kZ:
      return Eigen::Vector3d::UnitZ();
    default:
      throw std::logic_error("a free line has no axis");
  }
}

// A point landmark in the world, as the estimator outputs it.
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

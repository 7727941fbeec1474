// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
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

}  // namespace plm_vins

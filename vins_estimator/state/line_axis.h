// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <stdexcept>

namespace plm_vins {

// The axis of the Manhattan frame M that a line runs along; free where it runs along none.
enum class LineAxis { kFree, kX, kY, kZ };

// Unit vector in M; not for kFree.
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plm_vins {

// Two orthonormal columns that are perpendicular to the unit vector `v`.
inline Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& v) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = v.unitOrthogonal();
  basis.col(1) = v.cross(basis.col(0));
  return basis;
}

}  // namespace plm_vins

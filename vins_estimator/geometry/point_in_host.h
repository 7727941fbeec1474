// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// A point is given by its normalised image point and inverse depth in a host camera, (x, y, lambda
// [1/m]):
//   p_Ch = (x, y, 1) / lambda   ([Civera2008], with the host's own noise estimated as well).
constexpr int kPointSize = 3;

// Position in the host camera [m].
inline Eigen::Vector3d PointInHost(const double* point) {
  return Eigen::Vector3d(point[0], point[1], 1.0) / point[2];
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// Size of a point landmark's parameters: normalized image point and inverse depth in the host
// camera, (x, y, lambda [1/m]),
//   p_Ch = (x, y, 1) / lambda   ([Civera2008]; the host observation's noise is estimated, too).
constexpr int kPointSize = 3;

// Returns the position in the host camera [m].
inline Eigen::Vector3d PointInHost(const double* point) {
  return Eigen::Vector3d(point[0], point[1], 1.0) / point[2];
}

}  // namespace plm_vins

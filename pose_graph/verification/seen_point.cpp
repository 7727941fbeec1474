// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/seen_point.h"

#include <limits>

namespace plm_vins {

double SightingError(const SeenPoint& sighting, const LevelTransform& T_O_G,
                     const Eigen::Quaterniond& R_G_C) {
  const Eigen::Vector3d p_C = R_G_C.conjugate() * (T_O_G.Inverse() * sighting.p_O);
  if (p_C.z() <= 0) return std::numeric_limits<double>::infinity();
  return (p_C.hnormalized() - sighting.xy).norm();
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/seen_point.h"

namespace plm_vins {

double SightingError(const SeenPoint& sighting, const LevelTransform& T_O_G,
                     const Eigen::Quaterniond& R_G_C) {
  return Viewpoint(T_O_G, R_G_C).Error(sighting);
}

}  // namespace plm_vins

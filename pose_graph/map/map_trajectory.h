// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// An odometry pose and the number of the preceding keyframe.
struct OdometryPose {
  int64_t t_ns = 0;
  Rigid3d T_O_B;
  int keyframe = -1;
};

// Returns the pose in the map by the current estimate. The correction is interpolated between the
// two adjacent keyframes of the same world, which avoids steps.
Rigid3d PoseInMap(const KeyframeMap& map, const OdometryPose& pose);

}  // namespace plm_vins

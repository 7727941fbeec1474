// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// A pose of odometry and the keyframe before it, by number.
struct OdometryPose {
  int64_t t_ns = 0;
  Rigid3d T_O_B;
  int keyframe = -1;
};

// Where the pose is in the map as known now. Between two keyframes of its world the corrections
// pass into each other, so that there is no step.
Rigid3d PoseInMap(const KeyframeMap& map, const OdometryPose& pose);

}  // namespace plm_vins

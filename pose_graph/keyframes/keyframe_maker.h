// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "common/camera/camera_model.h"
#include "pose_graph/description/corner_selection.h"
#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/keyframes/odometry_frame.h"

namespace plm_vins {

// The keyframe of an image: the corners that odometry follows, filled up with others, all with
// descriptors. `world` and `path` are left to the caller. `camera` is the one that the rays of the
// frame were computed with.
Keyframe MakeKeyframe(const CornerSelectionOptions& options, const CameraModel& camera,
                      const OdometryFrame& frame);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "common/camera/camera_model.h"
#include "pose_graph/description/corner_selection.h"
#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/keyframes/odometry_frame.h"

namespace plm_vins {

// Makes the keyframe of an image from the tracked corners, supplemented by newly detected ones, all
// with descriptors. The caller sets `world` and `path`. `camera` is the model that the rays of the
// frame were computed with.
Keyframe MakeKeyframe(const CornerSelectionOptions& options, const CameraModel& camera,
                      const OdometryFrame& frame);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "offline/pipeline/odometry_pipeline.h"
#include "pose_graph/keyframes/odometry_frame.h"

namespace plm_vins {

// Converts the result of an image with a pose to the input of loop closure. `restarted` means that
// the world frame has changed since the previous image with a pose.
OdometryFrame ToOdometryFrame(const PipelineFrame& frame, bool restarted);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "offline/pipeline/odometry_pipeline.h"
#include "pose_graph/keyframes/odometry_frame.h"

namespace plm_vins {

// What loop closure takes of an image that has a pose. `restarted`: the world frame is a new one
// since the last image that had one.
OdometryFrame ToOdometryFrame(const PipelineFrame& frame, bool restarted);

}  // namespace plm_vins

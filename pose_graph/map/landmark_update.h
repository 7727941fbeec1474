// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {

// Copies the landmark positions of the last keyframe to the preceding keyframes that share its
// tracks, since triangulation improves with each observation. A keyframe keeps its own position if
// the new one has a reprojection error above `max_error` (normalized), as after a jump of odometry
// or a slipped track.
void UpdateLandmarks(double max_error, std::vector<Keyframe>* keyframes);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {

// Gives landmarks of the newest keyframe, the last one, their places in those before it that follow
// the same tracks: a place gets better with each view. Where it does not fit what an earlier
// keyframe saw (to `max_error`, normalised), as odometry jumped or the track slipped since, that
// one keeps its own.
void UpdateLandmarks(double max_error, std::vector<Keyframe>* keyframes);

}  // namespace plm_vins

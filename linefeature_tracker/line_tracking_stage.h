// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linefeature_tracker/line_tracker.h"
#include "tracking/tracking_stage.h"

namespace plm_vins {

// The line front end, as used by the node and the offline runner.
using LineTrackingStage = TrackingStage<LineTracker, &Config::lines>;
using TrackedLines = LineTrackingStage::Frame;

}  // namespace plm_vins

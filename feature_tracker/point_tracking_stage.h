// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "feature_tracker/point_tracker.h"
#include "tracking/tracking_stage.h"

namespace plm_vins {

// The point front end, as used by the node and the offline runner.
using PointTrackingStage = TrackingStage<PointTracker, &Config::points>;
using TrackedPoints = PointTrackingStage::Frame;

}  // namespace plm_vins

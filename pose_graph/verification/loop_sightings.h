// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/features/placed_features.h"
#include "common/geometry/rigid3.h"
#include "common/measurements.h"
#include "pose_graph/verification/seen_point.h"

namespace plm_vins {

// A line in space and where it is seen.
struct SeenSegment {
  SpaceSegment line;
  LineObservation segment;
};

// What ties two visits of a place together. O1: the odometry's world of the earlier one, O2: that
// of the later one.
struct LoopSightings {
  Rigid3d T_O1_C;                     // the camera of the earlier visit
  Rigid3d T_O2_C;                     // that of the later visit
  std::vector<SeenPoint> of_earlier;  // landmarks in O1, seen by the later camera
  std::vector<SeenPoint> of_later;    // landmarks in O2, seen by the earlier camera
  std::vector<SeenSegment> lines;     // in O1, seen by the later camera
};

}  // namespace plm_vins

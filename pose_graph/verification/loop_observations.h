// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/features/placed_features.h"
#include "common/geometry/rigid3.h"
#include "common/measurements.h"
#include "pose_graph/verification/seen_point.h"

namespace plm_vins {

// A 3-D line segment and its observation in an image.
struct SeenSegment {
  SpaceSegment line;
  LineObservation segment;
};

// Observations that connect two visits of a place. O1 is the odometry world of the earlier visit,
// O2 that of the later one.
struct LoopObservations {
  int earlier_camera = 0;
  int later_camera = 0;
  Rigid3d T_O1_C;                     // pose of the earlier camera
  Rigid3d T_O2_C;                     // pose of the later camera
  std::vector<SeenPoint> of_earlier;  // landmarks in O1, observed by the later camera
  std::vector<SeenPoint> of_later;    // landmarks in O2, observed by the earlier camera
  std::vector<SeenSegment> lines;     // in O1, observed by the later camera
};

}  // namespace plm_vins

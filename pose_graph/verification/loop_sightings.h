// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/features/placed_features.h"
#include "common/geometry/rigid3.h"
#include "common/measurements.h"
#include "pose_graph/verification/level_pose_ransac.h"

namespace plm_vins {

// A line in space and where it is seen.
struct SeenSegment {
  SpaceSegment line_A;
  LineObservation segment;
};

// What ties two visits of a place together. A: the odometry's world of the earlier one, B: that of
// the later one.
struct LoopSightings {
  Rigid3d T_A_C;                      // the camera of the earlier visit
  Rigid3d T_B_C;                      // that of the later visit
  std::vector<SeenPoint> of_earlier;  // landmarks in A, seen by the later camera
  std::vector<SeenPoint> of_later;    // landmarks in B, seen by the earlier camera
  std::vector<SeenSegment> lines;     // in A, seen by the later camera
};

}  // namespace plm_vins

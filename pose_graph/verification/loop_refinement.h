// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/rigid3.h"
#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/odometry_frame.h"
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

struct LoopRefinementOptions {
  double point_noise = 6.0 / 460;  // (normalised) of that, landmarks in error are the most
  double line_noise = 1.5 / 460;   // (normalised) of an end across the line
  // Of the result, on top of what the sightings say: what landmarks have wrong in common.
  double floor_position = 0.02;          // [m]
  double floor_yaw = 0.06 * M_PI / 180;  // [rad]
};

struct RefinedLoop {
  LevelTransform T_A_B;
  Matrix4d covariance;  // of the later visit's place and heading, with the axes of A, see LoopEdge
};

// The transform that fits all sightings best, from `start`; robust against some that are wrong.
// Nothing where the solver fails.
std::optional<RefinedLoop> RefineLoop(const LoopRefinementOptions& options,
                                      const LoopSightings& sightings, const LevelTransform& start);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/odometry_frame.h"

namespace plm_vins {

// How uncertain a step of odometry is, at least: scale and heading drift more than the window of an
// estimator knows.
struct OdometryNoise {
  double position_floor = 0.001;          // [m]
  double position_rate = 0.003;           // of the step [1]
  double yaw_floor = 0.003 * M_PI / 180;  // [rad]
  double yaw_rate = 0.02 * M_PI / 180;    // [rad/m]
};

// Covariance of the step from a keyframe to the next: by how much that of the pose grew, which is
// what the step added, and not less than the floor.
Matrix4d StepCovariance(const OdometryNoise& noise, const OdometryFrame& from,
                        const OdometryFrame& to);

}  // namespace plm_vins

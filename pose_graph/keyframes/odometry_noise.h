// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/geometry/drift_budget.h"
#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/keyframes/odometry_frame.h"

namespace plm_vins {

// How uncertain a step of odometry is, at least: scale and heading drift more than the window of an
// estimator knows.
struct OdometryNoise : DriftBudget {
  OdometryNoise() : DriftBudget{0.001, 0.003, 0.003 * M_PI / 180, 0.02 * M_PI / 180} {}
};

// Of (x, y, z, yaw) in O, out of what odometry says of all six degrees of freedom.
Matrix4d LevelCovariance(const OdometryFrame& frame);

// Covariance of the step from a keyframe to the next, and not less than the floor: by how much that
// of the pose grew, which is what the step added, or shrank, which is that of a correction. (The
// error that an optimal correction leaves does not correlate with it, so variances subtract.)
Matrix4d StepCovariance(const OdometryNoise& noise, const Keyframe& from, const Keyframe& to);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/drift_budget.h"
#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/odometry_frame.h"

namespace plm_vins {

// How uncertain a step of odometry is, at least: scale and heading drift more than the window of an
// estimator knows.
struct OdometryNoise : DriftBudget {
  OdometryNoise() : DriftBudget{0.001, 0.003, 0.003 * M_PI / 180, 0.02 * M_PI / 180} {}
};

// Covariance of the step from a keyframe to the next: by how much that of the pose grew, which is
// what the step added, and not less than the floor.
Matrix4d StepCovariance(const OdometryNoise& noise, const OdometryFrame& from,
                        const OdometryFrame& to);

}  // namespace plm_vins

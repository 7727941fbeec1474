// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/rigid3.h"
#include "pose_graph/geometry/drift_budget.h"
#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

// How uncertain a step of odometry is, at least: scale and heading drift more than the window of an
// estimator knows.
struct OdometryNoise : DriftBudget {
  OdometryNoise() : DriftBudget{0.001, 0.003, 0.003 * M_PI / 180, 0.02 * M_PI / 180} {}
};

// Of (x, y, z, yaw) in O, out of that of (p_O, theta_B), all six degrees of freedom.
Matrix4d LevelCovariance(const Rigid3d& T_O_B, const Eigen::Matrix<double, 6, 6>& covariance);

// Covariance of a step of odometry, and not less than the floor of its way: by how much that of the
// pose grew, which is what the step added, or shrank, which is that of a correction. (The error
// that an optimal correction leaves does not correlate with it, so variances subtract.)
Matrix4d StepCovariance(const OdometryNoise& noise, const Eigen::Vector3d& way,
                        const Matrix4d& growth);

}  // namespace plm_vins

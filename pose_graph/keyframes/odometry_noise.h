// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/rigid3.h"
#include "pose_graph/geometry/drift_budget.h"
#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

// Minimum uncertainty of the odometry between keyframes: scale and heading drift more than the
// estimator's window covariance shows.
struct OdometryNoise : DriftBudget {
  OdometryNoise() : DriftBudget{0.001, 0.003, 0.003 * M_PI / 180, 0.02 * M_PI / 180} {}
};

// Converts the covariance of (p_O, theta_B) to that of (x, y, z, yaw) in O.
Matrix4d LevelCovariance(const Rigid3d& T_O_B, const Eigen::Matrix<double, 6, 6>& covariance);

// Covariance of the relative pose between two keyframes: the absolute value of `growth`, the change
// of the pose covariance between them, and at least the drift over `way`. The covariance shrinks
// after a correction; the error after an optimal correction is uncorrelated with the correction, so
// the variances subtract.
Matrix4d StepCovariance(const OdometryNoise& noise, const Eigen::Vector3d& way,
                        const Matrix4d& growth);

}  // namespace plm_vins

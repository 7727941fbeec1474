// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "common/geometry/rigid3.h"
#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

// Standard deviations of odometry drift, as linear functions of the distance traveled.
struct DriftBudget {
  double position_floor;  // [m]
  double position_rate;   // per distance traveled [1]
  double yaw_floor;       // [rad]
  double yaw_rate;        // [rad/m]

  // Variances of (x, y, z, yaw) after `distance` [m].
  Vector4d Variances(double distance) const {
    Vector4d deviations;
    deviations << Eigen::Vector3d::Constant(position_floor + position_rate * distance),
        yaw_floor + yaw_rate * distance;
    return deviations.cwiseAbs2();
  }

  Matrix4d Covariance(double distance) const { return Variances(distance).asDiagonal(); }

  // Returns the distance traveled after which drift reaches these variances [m]; zero if they are
  // below the floor.
  double DistanceOf(const Vector4d& variances) const {
    const double position = std::sqrt(variances.head<3>().maxCoeff());
    const double yaw = std::sqrt(variances(3));
    return std::max(
        {0.0, (position - position_floor) / position_rate, (yaw - yaw_floor) / yaw_rate});
  }
};

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

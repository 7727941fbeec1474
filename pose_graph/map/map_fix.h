// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/rigid3.h"
#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/keyframes/odometry_noise.h"

namespace plm_vins {

// The place of an odometry's world O in the map M, as known by a keyframe L from which odometry
// leads on, and drifts.
struct MapFix {
  LevelTransform T_M_O;
  LevelTransform T_O_L;
  Matrix4d odometry_covariance = Matrix4d::Zero();  // of (x, y, z, yaw) of T_O_L, as it states it
  Matrix4d covariance = Matrix4d::Zero();           // of (x, y, z, yaw) of T_M_L
  OdometryNoise drift;
};

// Covariance of (x, y, z, yaw) in M of a pose at `p_O`, from what odometry states of it: that of
// the keyframe, and what odometry has drifted since.
Matrix4d LevelCovarianceInMap(const MapFix& fix, const Eigen::Vector3d& p_O,
                              const Matrix4d& odometry_covariance);

// The same of (p_M, theta_B), from that of (p_O, theta_B). Roll and pitch, which the map knows no
// better, stay.
Eigen::Matrix<double, 6, 6> CovarianceInMap(const MapFix& fix, const Rigid3d& T_O_B,
                                            const Eigen::Matrix<double, 6, 6>& odometry_covariance);

}  // namespace plm_vins

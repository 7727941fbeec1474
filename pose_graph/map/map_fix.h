// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/rigid3.h"
#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/keyframes/odometry_noise.h"

namespace plm_vins {

// Pose of the odometry's world O in the map M, known at a keyframe with frame L, from which
// odometry continues and drifts.
struct MapFix {
  LevelTransform T_M_O;
  LevelTransform T_O_L;
  Matrix4d odometry_covariance = Matrix4d::Zero();  // covariance of T_O_L as (x, y, z, yaw)
  Matrix4d covariance = Matrix4d::Zero();           // covariance of T_M_L as (x, y, z, yaw)
  OdometryNoise drift;
};

// Covariance of (x, y, z, yaw) in M of an odometry pose at `p_O`: that of the keyframe plus the
// drift of odometry since.
Matrix4d LevelCovarianceInMap(const MapFix& fix, const Eigen::Vector3d& p_O,
                              const Matrix4d& odometry_covariance);

// Covariance of (p_M, theta_B) from that of (p_O, theta_B). Roll and pitch keep the odometry's
// covariance, which the map does not improve.
Eigen::Matrix<double, 6, 6> CovarianceInMap(const MapFix& fix, const Rigid3d& T_O_B,
                                            const Eigen::Matrix<double, 6, 6>& odometry_covariance);

}  // namespace plm_vins

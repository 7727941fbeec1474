// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// The motion of a frame B that is fixed to a rigid body, in a world W, with covariances in the
// order and the frames of nav_msgs/Odometry, which are those that mavros wants.
struct BodyOdometry {
  using Matrix6d = Eigen::Matrix<double, 6, 6>;

  Rigid3d T_W_B;
  Eigen::Vector3d v_B = Eigen::Vector3d::Zero();      // of the origin of B, along its axes [m/s]
  Eigen::Vector3d omega_B = Eigen::Vector3d::Zero();  // of the body, along the axes of B [rad/s]
  Matrix6d pose_covariance = Matrix6d::Zero();  // p_W, rotation about the axes of W (from the left)
  Matrix6d twist_covariance = Matrix6d::Zero();  // v_B, omega_B

  // Finite numbers, and a rotation.
  bool IsUsable() const;
};

// The same motion of another frame A on the same body.
BodyOdometry MoveTo(const Rigid3d& T_B_A, const BodyOdometry& of_B);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// Motion of a frame B, fixed to a rigid body, in a world W. Covariances have the order and frames
// of nav_msgs/Odometry, which mavros expects.
struct BodyOdometry {
  using Matrix6d = Eigen::Matrix<double, 6, 6>;

  Rigid3d T_W_B;
  Eigen::Vector3d v_B = Eigen::Vector3d::Zero();      // velocity of the origin of B in B [m/s]
  Eigen::Vector3d omega_B = Eigen::Vector3d::Zero();  // angular velocity in B [rad/s]
  Matrix6d pose_covariance = Matrix6d::Zero();        // p_W, left rotation perturbation in W
  Matrix6d twist_covariance = Matrix6d::Zero();       // v_B, omega_B

  // Returns whether all numbers are finite and the rotation is valid.
  bool IsUsable() const;
};

// Converts the motion to another frame A on the same body.
BodyOdometry MoveTo(const Rigid3d& T_B_A, const BodyOdometry& of_B);

}  // namespace plm_vins

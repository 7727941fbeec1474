// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plm_vins {

// A rigid transform T_A_B, which transforms points from frame B to frame A: p_A = T_A_B * p_B =
// R_A_B p_B + p_A_B.
struct Rigid3d {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // origin of B in A [m]

  Rigid3d() = default;
  Rigid3d(const Eigen::Quaterniond& R_A_B, const Eigen::Vector3d& p_A_B)
      : rotation(R_A_B), translation(p_A_B) {}

  Eigen::Matrix3d R() const { return rotation.toRotationMatrix(); }

  // Returns T_B_A, the inverse of this T_A_B.
  Rigid3d Inverse() const {
    const Eigen::Quaterniond R_B_A = rotation.conjugate();
    return {R_B_A, -(R_B_A * translation)};
  }
};

// T_A_C = T_A_B * T_B_C.
inline Rigid3d operator*(const Rigid3d& T_A_B, const Rigid3d& T_B_C) {
  return {(T_A_B.rotation * T_B_C.rotation).normalized(),
          T_A_B.rotation * T_B_C.translation + T_A_B.translation};
}

// p_A = T_A_B * p_B.
inline Eigen::Vector3d operator*(const Rigid3d& T_A_B, const Eigen::Vector3d& p_B) {
  return T_A_B.rotation * p_B + T_A_B.translation;
}

}  // namespace plm_vins

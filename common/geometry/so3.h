// SPDX-License-Identifier: BSD-3-Clause
// The rotation group SO(3): exponential and logarithm maps, right Jacobians. Angles in radians.
// Formulas: [Forster2017], Eq. (3)-(11).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace plm_vins {

inline double ToDegrees(double radians) { return radians * 180 / M_PI; }

// The skew-symmetric matrix [v]x with [v]x w = v x w.
inline Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Rotation by the angle |phi| about phi, as a unit quaternion.
Eigen::Quaterniond SO3Exp(const Eigen::Vector3d& phi);

// Inverse of SO3Exp, with |result| <= pi. `q` must have unit length; q and -q are equivalent.
Eigen::Vector3d SO3Log(const Eigen::Quaterniond& q);

// Right Jacobian: Exp(phi + d) = Exp(phi) Exp(Jr(phi) d) to first order in d.
Eigen::Matrix3d SO3RightJacobian(const Eigen::Vector3d& phi);

// Inverse of SO3RightJacobian: Log(Exp(phi) Exp(d)) = phi + Jr^-1(phi) d to first order in d.
Eigen::Matrix3d SO3RightJacobianInverse(const Eigen::Vector3d& phi);

// The shortest rotation from direction `from` to direction `to`: to ~ R from.
Eigen::Quaterniond ShortestRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

// Returns the heading (yaw) of `q` in the z-up world, about z [rad]: that of its x axis, or, if
// that axis is steeper than 45 degrees, that of its y axis less a quarter turn.
double Yaw(const Eigen::Quaterniond& q);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
// The rotation group SO(3): exponential and logarithm maps, right Jacobians. Angles in radians.
// Formulas: [Forster2017], Eq. (3)-(11).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace plm_vins {

// The matrix [v]x with [v]x w = v x w.
inline Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Rotation by the angle |phi| about phi, as a unit quaternion.
inline Eigen::Quaterniond SO3Exp(const Eigen::Vector3d& phi) {
  const double angle_squared = phi.squaredNorm();
  const double angle = std::sqrt(angle_squared);
  // sin(a/2)/a, by its series where a is too small to divide by.
  const double scale = angle < 1e-6 ? 0.5 - angle_squared / 48.0 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q;
  q.w() = angle < 1e-6 ? 1.0 - angle_squared / 8.0 : std::cos(0.5 * angle);
  q.vec() = scale * phi;
  return q;
}

// The inverse of SO3Exp, with |result| <= pi. `q` must have unit length; q and -q give the same.
inline Eigen::Vector3d SO3Log(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  const double cosine = sign * q.w();
  const double scale = sine < 1e-9 ? 2.0 / cosine : 2.0 * std::atan2(sine, cosine) / sine;
  return sign * scale * q.vec();
}

// Right Jacobian: Exp(phi + d) = Exp(phi) Exp(Jr(phi) d) to first order in d.
inline Eigen::Matrix3d SO3RightJacobian(const Eigen::Vector3d& phi) {
  const double angle_squared = phi.squaredNorm();
  const Eigen::Matrix3d K = Skew(phi);
  if (angle_squared < 1e-10) return Eigen::Matrix3d::Identity() - 0.5 * K + K * K / 6.0;
  const double angle = std::sqrt(angle_squared);
  return Eigen::Matrix3d::Identity() - (1.0 - std::cos(angle)) / angle_squared * K +
         (angle - std::sin(angle)) / (angle_squared * angle) * K * K;
}

// Inverse of SO3RightJacobian: Log(Exp(phi) Exp(d)) = phi + Jr^-1(phi) d to first order in d.
inline Eigen::Matrix3d SO3RightJacobianInverse(const Eigen::Vector3d& phi) {
  const double angle_squared = phi.squaredNorm();
  const Eigen::Matrix3d K = Skew(phi);
  if (angle_squared < 1e-10) return Eigen::Matrix3d::Identity() + 0.5 * K + K * K / 12.0;
  const double angle = std::sqrt(angle_squared);
  const double cotangent_term =
      1.0 / angle_squared - (1.0 + std::cos(angle)) / (2.0 * angle * std::sin(angle));
  return Eigen::Matrix3d::Identity() + 0.5 * K + cotangent_term * K * K;
}

// The shortest rotation that turns direction `from` into direction `to`: to ~ R from.
inline Eigen::Quaterniond ShortestRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

// Rotation about z by the heading (yaw) of `q` in the z-up world.
inline double Yaw(const Eigen::Quaterniond& q) {
  const Eigen::Vector3d x_axis = q * Eigen::Vector3d::UnitX();
  return std::atan2(x_axis.y(), x_axis.x());
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/so3.h"

#include <cmath>

namespace plm_vins {

Eigen::Quaterniond SO3Exp(const Eigen::Vector3d& phi) {
  const double angle_squared = phi.squaredNorm();
  const double angle = std::sqrt(angle_squared);
  // sin(a/2)/a, by its Taylor series for small a.
  const double scale = angle < 1e-6 ? 0.5 - angle_squared / 48.0 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q;
  q.w() = angle < 1e-6 ? 1.0 - angle_squared / 8.0 : std::cos(0.5 * angle);
  q.vec() = scale * phi;
  return q;
}

Eigen::Vector3d SO3Log(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  const double cosine = sign * q.w();
  const double scale = sine < 1e-9 ? 2.0 / cosine : 2.0 * std::atan2(sine, cosine) / sine;
  return sign * scale * q.vec();
}

Eigen::Matrix3d SO3RightJacobian(const Eigen::Vector3d& phi) {
  const double angle_squared = phi.squaredNorm();
  const Eigen::Matrix3d K = Skew(phi);
  if (angle_squared < 1e-10) return Eigen::Matrix3d::Identity() - 0.5 * K + K * K / 6.0;
  const double angle = std::sqrt(angle_squared);
  return Eigen::Matrix3d::Identity() - (1.0 - std::cos(angle)) / angle_squared * K +
         (angle - std::sin(angle)) / (angle_squared * angle) * K * K;
}

Eigen::Matrix3d SO3RightJacobianInverse(const Eigen::Vector3d& phi) {
  const double angle_squared = phi.squaredNorm();
  const Eigen::Matrix3d K = Skew(phi);
  if (angle_squared < 1e-10) return Eigen::Matrix3d::Identity() + 0.5 * K + K * K / 12.0;
  const double angle = std::sqrt(angle_squared);
  const double cotangent_term =
      1.0 / angle_squared - (1.0 + std::cos(angle)) / (2.0 * angle * std::sin(angle));
  return Eigen::Matrix3d::Identity() + 0.5 * K + cotangent_term * K * K;
}

Eigen::Quaterniond ShortestRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  if (cosine < -1 + 1e-12) return Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, a.unitOrthogonal()));
  const double scale = std::sqrt(2 * (1 + cosine));
  Eigen::Quaterniond q;
  q.w() = 0.5 * scale;
  q.vec() = a.cross(b) * (1 / scale);
  return q;
}

double Yaw(const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d R = q.toRotationMatrix();
  const bool is_x_steep = std::abs(R(2, 0)) > M_SQRT1_2;
  return is_x_steep ? std::atan2(-R(0, 1), R(1, 1)) : std::atan2(R(1, 0), R(0, 0));
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// (x, y, z [m], yaw [rad]): the degrees of freedom in which odometry drifts; gravity makes roll and
// pitch observable.
using Vector4d = Eigen::Vector4d;
using Matrix4d = Eigen::Matrix4d;

inline double WrapAngle(double angle) { return std::remainder(angle, 2 * M_PI); }

// A rigid transform T_A_B between two frames with z up: p_A = Rz(yaw) p_B + translation.
struct LevelTransform {
  double yaw = 0;                                         // [rad]
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // origin of B in A [m]

  Eigen::Quaterniond rotation() const {
    return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  }
  Rigid3d ToRigid() const { return {rotation(), translation}; }
  Vector4d ToVector() const {
    return {translation.x(), translation.y(), translation.z(), WrapAngle(yaw)};
  }
  static LevelTransform FromVector(const Vector4d& v) { return {v(3), v.head<3>()}; }

  LevelTransform Inverse() const { return {-yaw, -(rotation().conjugate() * translation)}; }
};

inline LevelTransform operator*(const LevelTransform& T_A_B, const LevelTransform& T_B_C) {
  return {WrapAngle(T_A_B.yaw + T_B_C.yaw),
          T_A_B.rotation() * T_B_C.translation + T_A_B.translation};
}

inline Eigen::Vector3d operator*(const LevelTransform& T_A_B, const Eigen::Vector3d& p_B) {
  return T_A_B.rotation() * p_B + T_A_B.translation;
}

// Least-squares alignment of frames by a level transform: the closed form of [Umeyama1991]
// restricted to rotations about z. Minimizes the squared errors of (x, y, z) and of the heading,
// expressed as the displacement it causes at 1 m.
class LevelFit {
 public:
  void Add(const LevelTransform& from, const LevelTransform& to) {
    ++count_;
    mean_from_ += (from.translation - mean_from_) / count_;
    const Eigen::Vector3d offset = from.translation - mean_from_;  // from the updated mean
    const Eigen::Vector3d before = to.translation - mean_to_;  // from the mean before the update
    mean_to_ += before / count_;
    dot_ += before.head<2>().dot(offset.head<2>()) + std::cos(to.yaw - from.yaw);
    cross_ += offset.x() * before.y() - offset.y() * before.x() + std::sin(to.yaw - from.yaw);
  }

  // T_to_from; identity if no frames were added.
  LevelTransform Transform() const {
    LevelTransform T;
    T.yaw = std::atan2(cross_, dot_);
    T.translation = mean_to_ - T.rotation() * mean_from_;
    return T;
  }

 private:
  double count_ = 0;
  Eigen::Vector3d mean_from_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_to_ = Eigen::Vector3d::Zero();
  double dot_ = 0;
  double cross_ = 0;
};

}  // namespace plm_vins

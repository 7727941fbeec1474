// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

// The level transform that takes frames to where others are, with the least sum of squares of
// (x, y, z) and of what the turn of a heading is at 1 m: the closed form of [Umeyama1991] about z.
class LevelFit {
 public:
  void Add(const LevelTransform& from, const LevelTransform& to) {
    ++count_;
    mean_from_ += (from.translation - mean_from_) / count_;
    const Eigen::Vector3d offset = from.translation - mean_from_;  // from the mean with it
    const Eigen::Vector3d before = to.translation - mean_to_;      // from the mean without it
    mean_to_ += before / count_;
    dot_ += before.head<2>().dot(offset.head<2>()) + std::cos(to.yaw - from.yaw);
    cross_ += offset.x() * before.y() - offset.y() * before.x() + std::sin(to.yaw - from.yaw);
  }

  // T_to_from; the identity where nothing was added.
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// Velocity that the accelerometer has measured since a standstill while the corners rest in the
// image. If it is large, the view moves along (a lift, a vehicle), or the scene is too far away to
// tell. Changes that last longer than a lift accelerates are those of the bias.
class UnseenMotion {
 public:
  // Adds the samples up to an image in which the corners rest. `is_standstill`: the IMU is quiet.
  void Add(const std::vector<ImuSample>& imu, bool is_standstill);

  // Returns whether the velocity is larger than noise and bias walks explain.
  bool IsFelt() const { return is_felt_; }
  const Eigen::Vector3d& position() const { return position_; }  // changes by the motion [m]

  // Forgets the standstill; the position stays.
  void Reset();

 private:
  bool is_felt_ = false;
  double rest_ = 0;                                  // duration of the reference [s]
  Eigen::Vector3d accel_ = Eigen::Vector3d::Zero();  // at standstill [m/s^2]
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero(), position_ = Eigen::Vector3d::Zero();
  double greatest_speed_ = 0, acceleration_ = 0;  // since the motion is felt [m/s], [s]
};

}  // namespace plm_vins

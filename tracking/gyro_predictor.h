// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>

#include "common/geometry/rigid3.h"
#include "common/imu/imu_door.h"
#include "common/measurements.h"

namespace plm_vins {

// Integrates the gyroscope to the camera's rotation between two images, which predicts the motion
// of features. Keeps a bounded history, which is cleared if the clock was set (ImuDoor).
class GyroPredictor {
 public:
  // `td` satisfies t_imu = t_image + td [s].
  GyroPredictor(const Rigid3d& T_B_C, double td, const ImuSensor& imu = ImuSensor());

  void AddImu(const ImuSample& sample);

  // Returns whether the samples reach the time of the image.
  bool Covers(int64_t t_image_ns) const;

  // Returns the rotation that takes directions in the camera at t0 to the camera at t1. Returns
  // nullopt if the samples do not cover the interval or have a gap in it.
  std::optional<Eigen::Quaterniond> Rotation(int64_t t0_ns, int64_t t1_ns) const;

 private:
  Eigen::Quaterniond R_B_C_;
  int64_t td_ns_;
  std::deque<ImuSample> samples_;
  ImuDoor door_;
};

}  // namespace plm_vins

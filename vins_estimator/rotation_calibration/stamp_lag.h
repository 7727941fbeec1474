// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// Searches for the delay between the timestamps of a camera and those of the IMU if it is too large
// for a linear fit (RotationFit), up to half a second: rotations of the camera are compared with
// those of the gyroscope at every lag.
class StampLag {
 public:
  explicit StampLag(const Eigen::Quaterniond& R_B_C) : R_B_C_(R_B_C) {}

  // Adds the samples up to the next image, starting with the last one before.
  void AddImu(const std::vector<ImuSample>& imu);

  // Adds a rotation of the camera between two images. Timestamps are those of the IMU, as the
  // configured delay gives them; `deviation` is that of the angle [rad].
  void AddRotation(int64_t then_ns, int64_t now_ns, const Eigen::Quaterniond& R_then_now,
                   double deviation);

  // Forgets all, as after a gap or a jump of the clock.
  void Clear();

  // Returns the lag [s]: the images show what the gyroscope measured at their timestamp plus the
  // lag. nullopt if zero explains the rotations as well, if too few were added, or if the motion
  // repeats so that several lags explain them.
  std::optional<double> lag() const;

 private:
  static constexpr int kHalf = 25;  // lags to each side
  static constexpr int kLags = 2 * kHalf + 1;

  struct Attitude {
    int64_t t_ns;
    Eigen::Quaterniond R_G_B;  // G: any frame
  };
  struct CameraRotation {
    int64_t then_ns, now_ns;
    Eigen::Quaterniond R_then_now;
    double deviation;
  };

  Eigen::Quaterniond AttitudeAt(int64_t t_ns) const;
  void Compare(const CameraRotation& rotation);

  Eigen::Quaterniond R_B_C_;
  std::deque<Attitude> attitudes_;      // by the gyroscope, oldest first
  std::deque<CameraRotation> waiting_;  // for the gyroscope to reach all lags
  std::array<double, kLags> costs_ = {};
  int compared_ = 0;
};

}  // namespace plm_vins

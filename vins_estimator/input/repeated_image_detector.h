// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/imu/imu_stillness.h"

namespace plm_vins {

// Detects images that a camera, driver or network sends again under a new timestamp: all corners
// are bitwise equal although the body moves, according to the IMU or to the estimated velocity. In
// real images noise moves the corners; in noise-free simulated images they are equal only at
// standstill.
class RepeatedImageDetector {
 public:
  explicit RepeatedImageDetector(const ImuNoise& noise) : imu_(noise, ImuStillness::Options()) {}

  // Adds the next image with the IMU samples since the previous one, and a lower bound on the
  // body's speed [m/s]. Returns whether the image repeats the previous one.
  bool Add(const FrameMeasurement& measurement, double least_speed);

 private:
  ImuStillness imu_;
  PointFrame before_;
};

}  // namespace plm_vins

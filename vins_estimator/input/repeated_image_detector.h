// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/imu/imu_stillness.h"

namespace plm_vins {

// Recognises images that a camera, its driver or the network sends again under a new stamp: all
// corners are where they were, to the last bit, and yet the body moves, by the IMU or by what is
// known of its velocity. Noise moves the corners of every real image; those of a simulated camera
// without noise rest for as long as it does.
class RepeatedImageDetector {
 public:
  explicit RepeatedImageDetector(const ImuNoise& noise) : imu_(noise, ImuStillness::Options()) {}

  // Takes the next image with the IMU samples that lead to it, and how fast the body is at least
  // [m/s]. Whether it repeats the one before.
  bool Add(const FrameMeasurement& measurement, double least_speed);

  void Reset();

 private:
  ImuStillness imu_;
  PointFrame before_;
};

}  // namespace plm_vins

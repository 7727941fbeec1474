// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/imu/imu_stillness.h"

namespace plm_vins {

// Detects standstill from the last half second of IMU samples and tracked corners: the IMU is still
// (ImuStillness), and the median corner is where it was at the start of the window. Both are
// required: smooth flight resembles standstill for the IMU, a distant scene for the camera.
//
// The common motion of the corners is a more sensitive measure than their distances, to which noise
// contributes.
class StandstillDetector {
 public:
  struct Options {
    ImuStillness::Options imu;
    double max_motion_px = 1.0;  // median corner motion over the window [px]
    int min_points = 10;         // corners that must be tracked through the window
  };

  struct Standstill {
    int64_t since_ns = 0;  // time of the image at the start of the window
    double common_px = 0;  // common motion of the corners since that image [px]
  };

  StandstillDetector(const ImuNoise& noise, const Options& options);
  explicit StandstillDetector(const ImuNoise& noise) : StandstillDetector(noise, Options()) {}

  // Adds the next image with the IMU samples since the previous one. Returns nullopt if the body
  // moved within the window, and until the window is full.
  std::optional<Standstill> Add(const FrameMeasurement& measurement);

  void Reset();

 private:
  Options options_;
  ImuStillness imu_;
  std::deque<PointFrame> points_;  // of the images in the window
};

}  // namespace plm_vins

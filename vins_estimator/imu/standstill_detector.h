// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/imu/imu_stillness.h"

namespace plm_vins {

// Says whether the body stands still, from the last half second of IMU samples and tracked corners:
// where the IMU is still (ImuStillness), and the median corner is where it was at the start of the
// window. Both must agree: a smooth flight can fool the IMU, a view of the far horizon the camera.
//
// What corners have in common tells of less motion than their distances, which noise adds up in.
class StandstillDetector {
 public:
  struct Options {
    ImuStillness::Options imu;
    double max_motion_px = 1.0;  // median corner motion over the window [px]
    int min_points = 10;         // corners that must be tracked through the window
  };

  struct Standstill {
    int64_t since_ns = 0;  // stamp of the image that opens the window
    double common_px = 0;  // motion that corners have in common, from that image to this [px]
  };

  StandstillDetector(const ImuNoise& noise, const Options& options);
  explicit StandstillDetector(const ImuNoise& noise) : StandstillDetector(noise, Options()) {}

  // Takes the next image with the IMU samples that lead to it. Nothing where the body did not stand
  // still from the start of the window to this image, and until the window is full.
  std::optional<Standstill> Add(const FrameMeasurement& measurement);

  void Reset();

 private:
  Options options_;
  ImuStillness imu_;
  std::deque<PointFrame> points_;  // of the images since the start of the window
};

}  // namespace plm_vins

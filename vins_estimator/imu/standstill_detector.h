// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"

namespace plm_vins {

// Says whether the body stands still, from the last half second of IMU samples and tracked corners.
// Both must agree: a smooth flight can fool the IMU, a view of the far horizon the camera.
//
//  - IMU: angular rate and specific force, averaged over each image interval, hardly vary. They are
//    averaged because propellers shake a vehicle on the ground as strongly as a flying one (up to
//    1 m/s^2), but about zero. Constant biases drop out, so they need not be known.
//  - Camera: the median corner is where it was at the start of the window.
//
// What corners have in common tells of less motion than their distances, which noise adds up in.
class StandstillDetector {
 public:
  struct Options {
    double window = 0.5;        // [s] looked back, more where images come seldom
    double max_window = 1.5;    // [s]
    double noise_factor = 3.0;  // allowed deviation, in standard deviations of the sensor noise
    double min_gyro_deviation = 0.025;  // [rad/s] always allowed: a vehicle with running propellers
    double min_accel_deviation = 0.2;   // [m/s^2] the same
    double max_motion_px = 1.0;         // median corner motion over the window [px]
    int min_points = 10;                // corners that must be tracked through the window
    int min_intervals = 4;              // image intervals since the window's start
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

  void Reset() { intervals_.clear(); }

 private:
  struct Interval {
    int64_t t_ns = 0;                                 // image that closes it
    Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // mean [rad/s]
    Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // mean [m/s^2]
    PointFrame points;                                // of the image that closes it
  };

  double Duration() const;  // of the window [s]
  bool HasIntervals(int count) const;
  bool IsFull() const;
  bool ImuIsQuiet() const;

  ImuNoise noise_;
  Options options_;
  std::deque<Interval> intervals_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"

namespace plm_vins {

// Detects whether angular rate and specific force, averaged over each image interval, hardly vary
// in the last half second. Averaging is necessary because propellers cause the same zero-mean
// vibration on the ground as in flight (up to 1 m/s^2). Constant biases cancel out and need not be
// known. Steady motion is indistinguishable from standstill.
class ImuStillness {
 public:
  struct Options {
    double window = 0.5;        // [s] duration, longer if images are rare
    double max_window = 1.5;    // [s]
    double noise_factor = 3.0;  // allowed deviation, in standard deviations of the sensor noise
    double min_gyro_deviation = 0.025;  // [rad/s] always allowed: vibration by propellers
    double min_accel_deviation = 0.2;   // [m/s^2] always allowed
    int min_intervals = 4;              // least number of image intervals in the window
  };

  ImuStillness(const ImuNoise& noise, const Options& options);

  // Adds the samples between the previous image and this one.
  void Add(const FrameMeasurement& measurement);

  bool IsKnown() const;          // the window is full
  bool IsQuiet() const;          // false if unknown
  bool ShowsNoiseAlone() const;  // quiet without what is always allowed; false if unknown
  int64_t since_ns() const { return intervals_.front().t_ns; }  // first image of a full window
  size_t images() const { return intervals_.size(); }           // includes that image

  void Reset() { intervals_.clear(); }

 private:
  struct Interval {
    int64_t t_ns = 0;                                 // image at its end
    Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // mean [rad/s]
    Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // mean [m/s^2]
  };

  double Duration() const;  // length of the window [s]
  // Returns whether the deviations are at most those of the noise, or these.
  bool VariesWithin(double gyro_deviation, double accel_deviation) const;
  bool HasIntervals(int count) const;

  ImuNoise noise_;
  Options options_;
  std::deque<Interval> intervals_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"

namespace plm_vins {

// Whether angular rate and specific force, averaged over each image interval, hardly vary in the
// last half second. They are averaged because propellers shake a vehicle on the ground as strongly
// as a flying one (up to 1 m/s^2), but about zero. Constant biases drop out, so they need not be
// known; steady motion shows no more than standstill does.
class ImuStillness {
 public:
  struct Options {
    double window = 0.5;        // [s] looked back, more where images come seldom
    double max_window = 1.5;    // [s]
    double noise_factor = 3.0;  // allowed deviation, in standard deviations of the sensor noise
    double min_gyro_deviation = 0.025;  // [rad/s] always allowed: a vehicle with running propellers
    double min_accel_deviation = 0.2;   // [m/s^2] the same
    int min_intervals = 4;              // image intervals since the window's start
  };

  ImuStillness(const ImuNoise& noise, const Options& options);

  // Takes the samples that lead to the next image.
  void Add(const FrameMeasurement& measurement);

  bool IsKnown() const;  // the window is full
  bool IsQuiet() const;  // false, too, where that is not known
  int64_t since_ns() const { return intervals_.front().t_ns; }  // image that opens a full window
  size_t images() const { return intervals_.size(); }           // in the window, with that one

  void Reset() { intervals_.clear(); }

 private:
  struct Interval {
    int64_t t_ns = 0;                                 // image that closes it
    Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // mean [rad/s]
    Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // mean [m/s^2]
  };

  double Duration() const;  // of the window [s]
  bool HasIntervals(int count) const;

  ImuNoise noise_;
  Options options_;
  std::deque<Interval> intervals_;
};

}  // namespace plm_vins

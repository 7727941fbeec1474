// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <deque>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "common/statistics.h"

namespace plm_vins {

// Measures the white noise of an IMU from its own samples, without a camera: from second
// differences of three consecutive samples, which motion hardly affects and whose variance is six
// times that of a sample if the noise is white. Vibration counts as noise.
class ImuNoiseMeter {
 public:
  void Add(const ImuSample& sample) {
    samples_.push_back(sample);
    if (samples_.size() < 3) return;
    const ImuSample &a = samples_[0], &b = samples_[1], &c = samples_[2];
    const double first = ToSeconds(b.t_ns - a.t_ns), second = ToSeconds(c.t_ns - b.t_ns);
    if (first > 0 && std::abs(second - first) < 0.5 * first) {
      AddForgetting(kForgetting, 1.0, &weight_);
      AddForgetting(kForgetting, 0.5 * (first + second), &interval_);
      AddForgetting(kForgetting, MeanSquare(a.gyro - 2 * b.gyro + c.gyro), &gyro_);
      AddForgetting(kForgetting, MeanSquare(a.accel - 2 * b.accel + c.accel), &accel_);
    }
    samples_.pop_front();
  }

  // Densities [rad/s/sqrt(Hz), m/s^2/sqrt(Hz)]; zero without samples.
  double gyro_density() const { return Density(gyro_); }
  double accel_density() const { return Density(accel_); }

 private:
  static constexpr double kForgetting = 0.001;  // per sample: five seconds at 200 Hz
  static constexpr double kVarianceFactor = 6;  // 1 + 4 + 1

  static double MeanSquare(const Eigen::Vector3d& difference) {
    return difference.squaredNorm() / 3;
  }
  double Density(double sum) const {
    if (!(weight_ > 0)) return 0;
    return std::sqrt(sum / weight_ / kVarianceFactor * interval_ / weight_);
  }

  std::deque<ImuSample> samples_;  // the newest two
  double weight_ = 0, interval_ = 0, gyro_ = 0, accel_ = 0;
};

}  // namespace plm_vins

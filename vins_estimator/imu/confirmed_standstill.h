// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/imu/imu_noise_meter.h"

namespace plm_vins {

// Tests by the IMU alone whether a standstill that the camera confirmed continues: its integrated
// readings must equal those of the standstill within noise and bias walks. Biases and gravity
// cancel out. Configured noise covers flight; at standstill, the samples often show far less.
class ConfirmedStandstill {
 public:
  explicit ConfirmedStandstill(const ImuNoise& noise) : noise_(noise) {}

  // Adds the IMU samples up to the next image.
  void Add(const FrameMeasurement& measurement);

  // Declares that the body has stood still from Reset() up to this image.
  void Confirm();

  // Returns whether the standstill continues according to the IMU. Returns false if no standstill
  // was confirmed.
  bool Continues() const;

  // Speed that the body may have gained without the IMU showing it [m/s].
  double UnnoticedVelocity() const;

  double TimeSince() const { return since_.duration; }  // since the last Confirm() [s]

  void Reset();

 private:
  // Integrals of the readings over an interval.
  struct Integral {
    double duration = 0;                              // [s]
    Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // [rad]
    Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // [m/s]
  };

  // Limit on the difference of an integral from its reference, for white noise and a random walk of
  // these densities.
  double Limit(double density, double walk, double least) const;
  double GyroDensity() const;   // of the samples, at most as configured
  double AccelDensity() const;  // of the samples, at most as configured

  ImuNoise noise_;
  ImuNoiseMeter meter_;
  Integral confirmed_, since_;
};

}  // namespace plm_vins

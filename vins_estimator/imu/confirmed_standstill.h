// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"

namespace plm_vins {

// Whether the IMU still reads what it read during a standstill that the camera confirmed: the
// difference, integrated since then, is within what noise explains. Biases and gravity drop out.
class ConfirmedStandstill {
 public:
  explicit ConfirmedStandstill(const ImuNoise& noise) : noise_(noise) {}

  // Takes the samples that lead to the next image.
  void Add(const FrameMeasurement& measurement);

  // The body has stood still up to this image since Reset().
  void Confirm();

  // Returns whether the standstill continues as far as the IMU can tell; false if none was
  // confirmed.
  bool Continues() const;

  // Norm of the velocity that the IMU would not notice [m/s].
  double UnnoticedVelocity() const;

  double TimeSince() const { return since_.duration; }  // ... the last Confirm() [s]

  void Reset();

 private:
  // Integrals of the readings over a time.
  struct Integral {
    double duration = 0;                              // [s]
    Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // [rad]
    Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // [m/s]
  };

  // Limit on the difference of an integral from its reference, for white noise of this density.
  double Limit(double density, double least) const;

  ImuNoise noise_;
  Integral confirmed_, since_;
};

}  // namespace plm_vins

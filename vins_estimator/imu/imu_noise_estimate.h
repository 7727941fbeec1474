// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/imu/imu_noise.h"
#include "vins_estimator/imu/imu_noise_evidence.h"

namespace plm_vins {

// Density of one source of noise: the root of the mean variance over what was seen last. It begins
// as configured, which counts as a little evidence.
class DensityEstimate {
 public:
  explicit DensityEstimate(double configured);

  void Add(const DensityEvidence& evidence);

  double density() const;

 private:
  double configured_;
  double squares_, redundancy_;  // sums that forget; the variance is their quotient
};

constexpr double kMostNoise = 16;  // that is believed, in times of the configured density

// Noise of the IMU on this vehicle, as the camera shows it in flight. Data sheets are of a sensor
// at rest; propellers shake it. Only ever noisier than configured, and by 16 times at most: what is
// configured also covers what no calm piece of flight shows.
class ImuNoiseEstimate {
 public:
  explicit ImuNoiseEstimate(const ImuNoise& configured);

  void Add(const ImuNoiseEvidence& evidence);

  // Of the accelerometer for times of a second, over which shaking is more than intervals between
  // keyframes show. The biases wander as configured.
  ImuNoise noise() const;
  const ImuNoise& configured() const { return configured_; }

 private:
  ImuNoise configured_;
  DensityEstimate accel_, gyro_;
};

}  // namespace plm_vins

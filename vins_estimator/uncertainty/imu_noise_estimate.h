// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/imu/imu_noise.h"

namespace plm_vins {

// Evidence of one interval between keyframes of the optimized window on one source of IMU noise.
struct DensityEvidence {
  double assumed = 0;   // density of its white noise, in the units of ImuNoise
  double squared = 0;   // squared residual attributed to this source
  double expected = 0;  // mean of `squared` if the noise is as assumed
  double slope = 0;     // increase of `expected` per multiple of the assumed variance
};

struct ImuNoiseEvidence {
  DensityEvidence accel, gyro;
};

// Estimates the density of one source of noise: the root of the mean variance with exponential
// forgetting. Starts at the configured density with a small weight.
class DensityEstimate {
 public:
  explicit DensityEstimate(double configured);

  void Add(const DensityEvidence& evidence);

  double density() const;

 private:
  double configured_;
  double squares_, redundancy_;  // forgetting sums; the variance is their quotient
};

constexpr double kMostNoise = 16;  // upper limit, times the configured density

// Estimates the noise of the IMU on this vehicle from the camera. Data sheets describe a sensor
// without vibration, but propellers shake it. The estimate is between 1 and 16 times the configured
// noise, which also covers effects that calm flight does not show.
class ImuNoiseEstimate {
 public:
  explicit ImuNoiseEstimate(const ImuNoise& configured);

  void Add(const ImuNoiseEvidence& evidence);

  // Noise in use. The accelerometer's density holds for about a second, over which vibration has
  // more effect than intervals between keyframes show. Bias random walks are as configured.
  ImuNoise noise() const;
  const ImuNoise& configured() const { return configured_; }

 private:
  ImuNoise configured_;
  DensityEstimate accel_, gyro_;
};

}  // namespace plm_vins

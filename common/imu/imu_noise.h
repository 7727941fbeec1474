// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace plm_vins {

// Noise of an IMU as continuous-time densities (as in Kalibr and data sheets), equal on all axes.
struct ImuNoise {
  double gyro_density = 1.7e-4;   // [rad/s/sqrt(Hz)]
  double accel_density = 2.0e-3;  // [m/s^2/sqrt(Hz)]
  double gyro_walk = 2.0e-5;      // bias random walk [rad/s^2/sqrt(Hz)]
  double accel_walk = 3.0e-3;     // bias random walk [m/s^3/sqrt(Hz)]
};

// The noise with the variance of its readings scaled; the biases wander as before.
inline ImuNoise Scaled(const ImuNoise& noise, double variance_scale) {
  const double scale = std::sqrt(variance_scale);
  return {noise.gyro_density * scale, noise.accel_density * scale, noise.gyro_walk,
          noise.accel_walk};
}

// The greater density of each source of noise.
inline ImuNoise Greater(const ImuNoise& a, const ImuNoise& b) {
  return {std::max(a.gyro_density, b.gyro_density), std::max(a.accel_density, b.accel_density),
          std::max(a.gyro_walk, b.gyro_walk), std::max(a.accel_walk, b.accel_walk)};
}

// Whether readings are noisier by more than a tenth: less is chance where noise is learned.
inline bool AreFarNoisier(const ImuNoise& noise, const ImuNoise& than) {
  constexpr double kFar = 1.1;
  return noise.accel_density > kFar * than.accel_density ||
         noise.gyro_density > kFar * than.gyro_density;
}

// Densities from the numbers of the VINS family, which belong to one sample interval dt = 1 / rate:
// a sample has standard deviation n [rad/s, m/s^2], so that one step adds n^2 dt^2 to the integral,
// and a bias changes by w dt per step, so that one step adds w^2 dt^2 to its variance. A density d
// adds d^2 dt in both cases; hence d = n sqrt(dt), and for the walk w sqrt(dt).
// (VINS-Mono's midpoint step, taking the noise of its two samples as independent, counts half of
// n^2 dt^2; we take the number for what it is called, the deviation of a sample.)
inline ImuNoise DensitiesFromSamples(const ImuNoise& per_sample, double rate_hz) {
  const double scale = std::sqrt(1.0 / rate_hz);
  return {per_sample.gyro_density * scale, per_sample.accel_density * scale,
          per_sample.gyro_walk * scale, per_sample.accel_walk * scale};
}

}  // namespace plm_vins

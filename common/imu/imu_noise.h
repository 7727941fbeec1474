// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace plm_vins {

// Noise of an IMU as continuous-time densities (as in Kalibr and data sheets), equal for all axes.
struct ImuNoise {
  double gyro_density = 1.7e-4;   // [rad/s/sqrt(Hz)]
  double accel_density = 2.0e-3;  // [m/s^2/sqrt(Hz)]
  double gyro_walk = 2.0e-5;      // bias random walk [rad/s^2/sqrt(Hz)]
  double accel_walk = 3.0e-3;     // bias random walk [m/s^3/sqrt(Hz)]
};

// Relative standard deviation of the scale factor of an accelerometer: real ones are off by 0.5 to
// 1 %. It is not estimated, but considered in what the IMU says of lengths (a consider parameter,
// [Schmidt1966]).
constexpr double kAccelScaleDeviation = 0.0075;

// Scales the variance of the white noise; the bias random walks are unchanged.
inline ImuNoise Scaled(const ImuNoise& noise, double variance_scale) {
  const double scale = std::sqrt(variance_scale);
  return {noise.gyro_density * scale, noise.accel_density * scale, noise.gyro_walk,
          noise.accel_walk};
}

// Returns the greater density of each noise source.
inline ImuNoise Greater(const ImuNoise& a, const ImuNoise& b) {
  return {std::max(a.gyro_density, b.gyro_density), std::max(a.accel_density, b.accel_density),
          std::max(a.gyro_walk, b.gyro_walk), std::max(a.accel_walk, b.accel_walk)};
}

// Returns whether the readings are noisier by more than a tenth; a smaller difference is within the
// uncertainty of the learned noise.
inline bool AreFarNoisier(const ImuNoise& noise, const ImuNoise& than) {
  constexpr double kFar = 1.1;
  return noise.accel_density > kFar * than.accel_density ||
         noise.gyro_density > kFar * than.gyro_density;
}

// Converts the noise parameters of VINS-Mono and its successors, which refer to one sample interval
// dt = 1 / rate, to densities. A sample has standard deviation n [rad/s, m/s^2], so that one step
// adds n^2 dt^2 to the variance of the integral; a bias changes by w dt per step, so that one step
// adds w^2 dt^2 to its variance. A density d adds d^2 dt in both cases; hence d = n sqrt(dt), and w
// sqrt(dt) for the random walk. (VINS-Mono's midpoint step assumes independent noise of its two
// samples and adds half of n^2 dt^2; here n is the standard deviation of a sample, as its name
// says.)
inline ImuNoise DensitiesFromSamples(const ImuNoise& per_sample, double rate_hz) {
  const double scale = std::sqrt(1.0 / rate_hz);
  return {per_sample.gyro_density * scale, per_sample.accel_density * scale,
          per_sample.gyro_walk * scale, per_sample.accel_walk * scale};
}

}  // namespace plm_vins

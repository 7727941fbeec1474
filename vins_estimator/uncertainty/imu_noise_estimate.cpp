// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/imu_noise_estimate.h"

#include <algorithm>
#include <cmath>

namespace plm_vins {
namespace {

// Redundancies; an interval between keyframes has up to five for the accelerometer, three for the
// gyroscope.
constexpr double kOfConfigured = 5;
constexpr double kRemembered = 100;  // determines a density to 7 %

constexpr double kLeastExpected = 1e-3;  // below: rounding errors
constexpr double kGreatestImuRatio = 9;  // above, an interval may be an outlier
constexpr double kLeastImuNoise = 1;     // times the configured density

// Vibration is not white noise: over a second, the variance of an accelerometer in flight is two to
// six times what intervals between keyframes show (docs/noise.md).
constexpr double kSlowShaking = 3;

// Ratio of the residuals' variance to the expected one. The robust loss down-weights images, so the
// solution follows the IMU more closely, and its residuals are smaller, than the equations state.
// Calibrated in simulated flights with the true noise configured.
constexpr double kShownOfAccel = 0.79, kShownOfGyro = 0.53;

DensityEvidence Shown(double share, DensityEvidence evidence) {
  evidence.expected *= share;
  return evidence;
}

// Returns the evidence of the same residual as if this density had been assumed.
DensityEvidence Assuming(double density, DensityEvidence evidence) {
  const double ratio = density / evidence.assumed;
  evidence.expected += (ratio * ratio - 1) * evidence.slope;
  evidence.assumed = density;
  return evidence;
}

// Returns the density whose variance exceeds the configured one by `times` the given excess.
double WithExcess(double times, double configured, double density) {
  const double excess = std::max(0.0, density * density - configured * configured);
  return std::sqrt(configured * configured + times * excess);
}

}  // namespace

DensityEstimate::DensityEstimate(double configured)
    : configured_(configured),
      squares_(kOfConfigured * configured * configured),
      redundancy_(kOfConfigured) {}

void DensityEstimate::Add(const DensityEvidence& evidence) {
  if (!(evidence.expected > kLeastExpected && evidence.squared >= 0)) return;
  const double squared = std::min(evidence.squared, kGreatestImuRatio * evidence.expected);
  squares_ += evidence.assumed * evidence.assumed * squared;
  redundancy_ += evidence.expected;
  const double kept = std::min(1.0, kRemembered / redundancy_);
  squares_ *= kept;
  redundancy_ *= kept;
}

double DensityEstimate::density() const {
  return std::clamp(std::sqrt(squares_ / redundancy_), kLeastImuNoise * configured_,
                    kMostNoise * configured_);
}

ImuNoiseEstimate::ImuNoiseEstimate(const ImuNoise& configured)
    : configured_(configured), accel_(configured.accel_density), gyro_(configured.gyro_density) {}

void ImuNoiseEstimate::Add(const ImuNoiseEvidence& evidence) {
  const double shown =
      WithExcess(1 / kSlowShaking, configured_.accel_density, evidence.accel.assumed);
  accel_.Add(Shown(kShownOfAccel, Assuming(shown, evidence.accel)));
  gyro_.Add(Shown(kShownOfGyro, evidence.gyro));
}

ImuNoise ImuNoiseEstimate::noise() const {
  ImuNoise noise = configured_;
  noise.accel_density =
      std::min(WithExcess(kSlowShaking, configured_.accel_density, accel_.density()),
               kMostNoise * configured_.accel_density);
  noise.gyro_density = gyro_.density();
  return noise;
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/imu_noise_estimate.h"

#include <algorithm>
#include <cmath>

namespace plm_vins {
namespace {

// Redundancies; an interval between keyframes has up to five of the accelerometer, three of the
// gyro.
constexpr double kOfConfigured = 5;
constexpr double kRemembered = 100;  // tell a density to 7 %

constexpr double kLeastExpected = 1e-3;   // less is rounding
constexpr double kGreatestRatio = 9;      // more of an interval may be an outlier
constexpr double kLeast = 1, kMost = 16;  // times the configured density

// Shares of the variance that residuals show. A robust loss lets images count for less than they
// tell, so the IMU has more of a say in the solution, and its residuals are smaller, than the
// equations state. Found in simulated flights with the true noise configured.
constexpr double kShownOfAccel = 0.79, kShownOfGyro = 0.53;

DensityEvidence Shown(double share, DensityEvidence evidence) {
  evidence.expected *= share;
  return evidence;
}

}  // namespace

DensityEstimate::DensityEstimate(double configured)
    : configured_(configured),
      squares_(kOfConfigured * configured * configured),
      redundancy_(kOfConfigured) {}

void DensityEstimate::Add(const DensityEvidence& evidence) {
  if (!(evidence.expected > kLeastExpected && evidence.squared >= 0)) return;
  const double squared = std::min(evidence.squared, kGreatestRatio * evidence.expected);
  squares_ += evidence.assumed * evidence.assumed * squared;
  redundancy_ += evidence.expected;
  const double kept = std::min(1.0, kRemembered / redundancy_);
  squares_ *= kept;
  redundancy_ *= kept;
}

double DensityEstimate::density() const {
  return std::clamp(std::sqrt(squares_ / redundancy_), kLeast * configured_, kMost * configured_);
}

ImuNoiseEstimate::ImuNoiseEstimate(const ImuNoise& configured)
    : configured_(configured), accel_(configured.accel_density), gyro_(configured.gyro_density) {}

void ImuNoiseEstimate::Add(const ImuNoiseEvidence& evidence) {
  accel_.Add(Shown(kShownOfAccel, evidence.accel));
  gyro_.Add(Shown(kShownOfGyro, evidence.gyro));
}

ImuNoise ImuNoiseEstimate::noise() const {
  ImuNoise noise = configured_;
  noise.accel_density = accel_.density();
  noise.gyro_density = gyro_.density();
  return noise;
}

}  // namespace plm_vins

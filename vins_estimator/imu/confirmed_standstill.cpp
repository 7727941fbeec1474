// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/confirmed_standstill.h"

#include <algorithm>
#include <cmath>

namespace plm_vins {
namespace {

constexpr double kMaxReference = 10.0;  // [s]: biases change over longer times
constexpr double kSigmas = 4.0;
// Changes that noise beyond the configured one and bias changes may cause.
constexpr double kLeastAngle = 0.01;     // [rad]
constexpr double kLeastVelocity = 0.05;  // [m/s]

}  // namespace

void ConfirmedStandstill::Add(const FrameMeasurement& measurement) {
  for (const ImuSample& sample : measurement.imu) meter_.Add(sample);
  for (size_t i = 1; i < measurement.imu.size(); ++i) {
    const ImuSample& from = measurement.imu[i - 1];
    const ImuSample& to = measurement.imu[i];
    const double dt = ToSeconds(to.t_ns - from.t_ns);
    since_.duration += dt;
    since_.gyro += 0.5 * dt * (from.gyro + to.gyro);
    since_.accel += 0.5 * dt * (from.accel + to.accel);
  }
}

void ConfirmedStandstill::Confirm() {
  confirmed_.duration += since_.duration;
  confirmed_.gyro += since_.gyro;
  confirmed_.accel += since_.accel;
  since_ = {};
  if (confirmed_.duration <= kMaxReference) return;
  const double share = kMaxReference / confirmed_.duration;
  confirmed_.duration *= share;
  confirmed_.gyro *= share;
  confirmed_.accel *= share;
}

bool ConfirmedStandstill::Continues() const {
  if (confirmed_.duration == 0) return false;
  const double ratio = since_.duration / confirmed_.duration;
  const Eigen::Vector3d turn = since_.gyro - ratio * confirmed_.gyro;
  const Eigen::Vector3d velocity = since_.accel - ratio * confirmed_.accel;
  return turn.norm() <= Limit(GyroDensity(), noise_.gyro_walk, kLeastAngle) &&
         velocity.norm() <= UnnoticedVelocity();
}

double ConfirmedStandstill::UnnoticedVelocity() const {
  return Limit(AccelDensity(), noise_.accel_walk, kLeastVelocity);
}

void ConfirmedStandstill::Reset() { confirmed_ = since_ = {}; }

// The integral of white noise over a time T has the variance density^2 T, and the mean over the
// reference time T_r, times T, has density^2 T^2 / T_r. The integral of a random walk has the
// variance walk^2 T^3 / 3.
double ConfirmedStandstill::Limit(double density, double walk, double least) const {
  const double T = since_.duration;
  const double variance =
      density * density * (T + T * T / confirmed_.duration) + walk * walk * T * T * T / 3;
  return std::max(least, kSigmas * std::sqrt(variance));
}

double ConfirmedStandstill::GyroDensity() const {
  return std::min(noise_.gyro_density, meter_.gyro_density());
}

double ConfirmedStandstill::AccelDensity() const {
  return std::min(noise_.accel_density, meter_.accel_density());
}

}  // namespace plm_vins

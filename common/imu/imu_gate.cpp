// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_gate.h"

#include <algorithm>
#include <cmath>

#include "common/format.h"
#include "common/imu/imu_samples.h"

namespace plm_vins {
namespace {

// Largest change between readings that a tap on a stationary body may cause.
constexpr double kAlwaysAllowedGyro = 1.0;    // [rad/s]
constexpr double kAlwaysAllowedAccel = 15.0;  // [m/s^2]

// A change is suspect beyond this multiple of the typical one; propellers reach four times.
constexpr double kLeapFactor = 6.0;
constexpr double kLearningRate = 0.01;  // per sample; averages over half a second

// Saturation limits. Sensors saturate slightly below the nominal values of their ranges: 2000 deg/s
// are 34.9 rad/s, 16 g are 156.9 m/s^2.
constexpr double kEndOfRange = 0.98;  // share of the range
constexpr double kCutOff = 0.5;       // possible excess of the true value, as a share of the range

constexpr int64_t kMaxInterval_ns = 50'000'000;  // readings further apart are not compared

// Largest absolute difference over the axes.
double Difference(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (b - a).cwiseAbs().maxCoeff();
}

// Difference between a reading, clamped to the sensor's range, and its replacement.
double Doubt(const Eigen::Vector3d& reading, const Eigen::Vector3d& replacement, double range) {
  return Difference(reading.cwiseMax(-range).cwiseMin(range), replacement);
}

// Returns whether the sample is saturated; if so, increases its doubt.
bool DoubtSaturated(const ImuRange& range, ImuSample* sample) {
  const bool gyro = sample->gyro.cwiseAbs().maxCoeff() >= kEndOfRange * range.gyro;
  const bool accel = sample->accel.cwiseAbs().maxCoeff() >= kEndOfRange * range.accel;
  if (gyro) sample->gyro_doubt = std::max(sample->gyro_doubt, kCutOff * range.gyro);
  if (accel) sample->accel_doubt = std::max(sample->accel_doubt, kCutOff * range.accel);
  return gyro || accel;
}

}  // namespace

double ImuGate::Leaps::Limit() const {
  return always_allowed + kLeapFactor * std::sqrt(mean_square);
}

// Clamps the change to the limit, so that single outliers hardly raise it, while persistent changes
// do.
void ImuGate::Leaps::Learn(double leap) {
  const double counted = std::min(leap, Limit());
  mean_square += kLearningRate * (counted * counted - mean_square);
}

ImuGate::ImuGate(const ImuSensor& sensor)
    : sensor_(sensor),
      range_(sensor.range),
      gyro_leaps_{kAlwaysAllowedGyro},
      accel_leaps_{kAlwaysAllowedAccel} {}

std::vector<ImuSample> ImuGate::Add(const ImuSample& sample) {
  const bool suspect = IsSuspect(sample);
  LearnLeaps(sample);
  if (suspect && static_cast<int>(suspects_.size()) < kMaxRun) {
    suspects_.push_back(sample);
    return {};
  }
  std::vector<ImuSample> decided = TakeSuspects(/*believed=*/suspect, sample);
  decided.push_back(sample);
  last_ = sample;
  for (ImuSample& next : decided) {
    const bool is_reading = suspect || next.t_ns == sample.t_ns;  // not a replacement
    if (is_reading) clipping_.Add(next);
    range_ = clipping_.Range(sensor_.range);
    if (DoubtSaturated(range_, &next) && is_reading) ++saturated_;
    next = Corrected(next, sensor_);
  }
  return decided;
}

std::string ImuGate::Clipping() const {
  std::string gyro, accel;
  if (range_.gyro < sensor_.range.gyro) {
    gyro = Format("the gyro ends at %.2f rad/s: choose a larger range in its driver", range_.gyro);
  }
  if (range_.accel < sensor_.range.accel) {
    accel = Format(
        "the accelerometer ends at %.1f m/s^2: choose a larger range in its driver, or damp "
        "vibration",
        range_.accel);
  }
  return JoinTexts({gyro, accel}, "; ");
}

void ImuGate::Clear() {
  last_.reset();
  suspects_.clear();
  gyro_leaps_.mean_square = accel_leaps_.mean_square = 0;
}

bool ImuGate::IsSuspect(const ImuSample& sample) const {
  if (!IsInRange(sample, sensor_.range)) return true;
  if (!last_ || sample.t_ns - Newest().t_ns > kMaxInterval_ns) return false;
  return Difference(last_->gyro, sample.gyro) > gyro_leaps_.Limit() ||
         Difference(last_->accel, sample.accel) > accel_leaps_.Limit();
}

const ImuSample& ImuGate::Newest() const { return suspects_.empty() ? *last_ : suspects_.back(); }

void ImuGate::LearnLeaps(const ImuSample& sample) {
  if (!last_) return;
  const ImuSample& before = Newest();
  if (sample.t_ns - before.t_ns > kMaxInterval_ns) return;
  gyro_leaps_.Learn(Difference(before.gyro, sample.gyro));
  accel_leaps_.Learn(Difference(before.accel, sample.accel));
}

std::vector<ImuSample> ImuGate::TakeSuspects(bool believed, const ImuSample& next) {
  std::vector<ImuSample> taken;
  taken.swap(suspects_);
  if (believed) return taken;
  for (ImuSample& suspect : taken) suspect = Replace(suspect, next);
  replaced_ += static_cast<int64_t>(taken.size());
  return taken;
}

ImuSample ImuGate::Replace(const ImuSample& suspect, const ImuSample& next) const {
  ImuSample replacement = last_ ? InterpolateImu(*last_, next, suspect.t_ns) : next;
  replacement.t_ns = suspect.t_ns;
  replacement.gyro_doubt = Doubt(suspect.gyro, replacement.gyro, sensor_.range.gyro);
  replacement.accel_doubt = Doubt(suspect.accel, replacement.accel, sensor_.range.accel);
  return replacement;
}

}  // namespace plm_vins

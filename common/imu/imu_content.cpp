// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_content.h"

#include <algorithm>

#include "common/format.h"
#include "common/imu/imu_range.h"

namespace plm_vins {
namespace {

constexpr int64_t kMinSamples = 200;
constexpr int64_t kMinSpan_ns = 2'000'000'000;

// Shares of the samples that count as most and as many.
constexpr double kMost = 0.8;
constexpr double kMany = 0.3;
constexpr double kFew = 0.05;

constexpr double kTolerance = 0.3;  // relative, of a norm near that of gravity
constexpr double kFarBelow = 0.3;   // largest share of gravity that is far below it
constexpr double kFastTurn = 4.0;  // [rad/s]; agile flights exceed it in a few samples of a hundred

bool IsPresent(const Eigen::Vector3d& reading) {
  return reading.allFinite() && !reading.isZero(0.0);
}

bool IsNear(double value, double expected) {
  return value > (1 - kTolerance) * expected && value < (1 + kTolerance) * expected;
}

double Share(int64_t part, int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

}  // namespace

void ImuContent::Add(const ImuSample& sample) {
  if (samples_++ == 0) first_ns_ = sample.t_ns;
  newest_ns_ = std::max(newest_ns_, sample.t_ns);
  const bool has_gyro = IsPresent(sample.gyro), has_accel = IsPresent(sample.accel);
  with_gyro_ += has_gyro;
  with_accel_ += has_accel;
  with_both_ += has_gyro && has_accel;
  if (has_gyro) fast_turns_ += sample.gyro.norm() > kFastTurn;
  if (!has_accel) return;
  const double force = sample.accel.norm();
  near_one_g_ += IsNear(force, 1);
  near_thousand_mg_ += IsNear(force, 1000);
  near_gravity_ += IsNear(force, gravity_norm_);
  beyond_range_ += force > kAnyImuRange.accel;
  far_below_gravity_ += force < kFarBelow * gravity_norm_;
}

std::string ImuContent::Finding(const std::string& topic) const {
  if (samples_ < kMinSamples) return "";
  std::string finding = MissingSensor(topic);
  if (finding.empty()) finding = WrongAccelerometer(topic);
  if (finding.empty()) finding = WrongGyro(topic);
  return finding;
}

std::string ImuContent::MissingSensor(const std::string& topic) const {
  if (with_gyro_ == 0 && with_accel_ == 0) {
    return "every sample on " + topic +
           " is zero: the driver cannot read the IMU; check its log and the connection";
  }
  const bool in_turn = with_both_ <= kFew * samples_ && with_gyro_ > kFew * samples_ &&
                       with_accel_ > kFew * samples_;
  if (in_turn) {
    return "gyro and accelerometer readings alternate on " + topic +
           ": unite them in one message (unite_imu_method of the driver)";
  }
  if (with_accel_ == 0 && with_gyro_ > 0) {
    return "specific force is zero in every sample: is " + topic +
           " the gyro's own topic? Unite both sensors (unite_imu_method of the driver)";
  }
  // A gyroscope that is simulated without noise reads zero during standstill.
  if (with_gyro_ == 0 && with_accel_ > 0 && newest_ns_ - first_ns_ > kMinSpan_ns) {
    return "angular velocity is zero in every sample: is " + topic +
           " the accelerometer's own topic? Unite both sensors (unite_imu_method of the driver)";
  }
  return "";
}

std::string ImuContent::WrongAccelerometer(const std::string& topic) const {
  if (Share(near_gravity_, with_accel_) > kMany) return "";
  if (Share(near_one_g_, with_accel_) > kMost) {
    return "specific force on " + topic + " seems to be in g: multiply it by 9.81, to m/s^2";
  }
  if (Share(near_thousand_mg_, with_accel_) > kMost) {
    return "specific force on " + topic + " seems to be in mg: multiply it by 0.00981, to m/s^2";
  }
  if (Share(beyond_range_, with_accel_) > kMost) {
    return Format("specific force exceeds %.0f m/s^2 in most samples: is ", kAnyImuRange.accel) +
           topic + " in mm/s^2, or in counts of the sensor? Convert it to m/s^2";
  }
  if (Share(far_below_gravity_, with_accel_) > kMost) {
    return "specific force on " + topic +
           " lacks gravity: publish raw accelerometer readings, including gravity";
  }
  return "";
}

std::string ImuContent::WrongGyro(const std::string& topic) const {
  const double share = Share(fast_turns_, with_gyro_);
  if (share < kMany || newest_ns_ - first_ns_ < kMinSpan_ns) return "";
  return Format("angular velocity exceeds %.0f rad/s in %.0f %% of the samples", kFastTurn,
                100 * share) +
         ": is " + topic + " in deg/s? Multiply it by pi/180, to rad/s";
}

}  // namespace plm_vins

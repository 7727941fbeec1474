// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_content.h"

#include <algorithm>

#include "common/forgetting_sum.h"
#include "common/imu/imu_range.h"

namespace plm_vins {
namespace {

// Properties of a sample. A sensor is present if its reading is finite and not zero; the others
// refer to the norm of the specific force, or of the angular rate.
enum Property {
  kAny,
  kHasGyro,
  kHasAccel,
  kHasBoth,
  kNearOneG,
  kNearThousandMg,
  kNearGravity,
  kFarBelowGravity,
  kBeyondRange,  // more than any IMU can read
  kFastTurn,     // blurs every image
};

constexpr int64_t kMinSamples = 200;
constexpr int64_t kMinSpan_ns = 2'000'000'000;
constexpr double kMemory = 10;         // [s]
constexpr double kMaxForgotten = 0.1;  // by a gap

// Shares of the samples that count as most, many, few and none.
constexpr double kMost = 0.8, kMany = 0.3, kFew = 0.05, kNone = 0.01;

constexpr double kTolerance = 0.3;   // relative, of a norm near that of gravity
constexpr double kFarBelow = 0.3;    // largest share of gravity that is far below it
constexpr double kFastTurnRate = 4;  // [rad/s]; agile flights exceed it in a few percent of samples

// Shares of the samples, or of those with an accelerometer or gyro.
struct Shares {
  double operator[](Property property) const { return Share(property, kAny); }
  double OfAccel(Property property) const { return Share(property, kHasAccel); }
  double OfGyro(Property property) const { return Share(property, kHasGyro); }
  // Returns whether the specific force is mostly of this kind, and seldom near gravity in m/s^2.
  bool MostForcesAre(Property property) const {
    return OfAccel(property) > kMost && OfAccel(kNearGravity) <= kMany;
  }

  const Eigen::Array<double, 10, 1>& numbers;
  bool is_long;  // more than two seconds

 private:
  double Share(Property part, Property whole) const {
    return numbers[whole] > 0 ? numbers[part] / numbers[whole] : 0;
  }
};

struct Test {
  bool (*fails)(const Shares& shares);
  const char *before_topic, *after_topic;  // what is wrong, around the topic
  const char* advice;
};

// The most serious one first.
constexpr Test kTests[] = {
    {[](const Shares& shares) { return shares[kHasGyro] < kNone && shares[kHasAccel] < kNone; },
     "every sample on ",
     " is zero: ", "the driver cannot read the IMU; check its log and the connection"},
    {[](const Shares& shares) {
       return shares[kHasBoth] <= kFew && std::min(shares[kHasGyro], shares[kHasAccel]) > kFew;
     },
     "gyro and accelerometer readings alternate on ", ": ",
     "unite them in one message (unite_imu_method of the driver)"},
    {[](const Shares& shares) { return shares[kHasAccel] < kNone; },
     "specific force is zero in every sample: is ", " the gyro's own topic? ",
     "Unite both sensors (unite_imu_method of the driver)"},
    // A gyroscope that is simulated without noise reads zero during standstill.
    {[](const Shares& shares) { return shares[kHasGyro] < kNone && shares.is_long; },
     "angular velocity is zero in every sample: is ", " the accelerometer's own topic? ",
     "Unite both sensors (unite_imu_method of the driver)"},
    {[](const Shares& shares) { return shares.MostForcesAre(kNearOneG); }, "specific force on ",
     " seems to be in g: ", "multiply it by 9.81, to m/s^2"},
    {[](const Shares& shares) { return shares.MostForcesAre(kNearThousandMg); },
     "specific force on ", " seems to be in mg: ", "multiply it by 0.00981, to m/s^2"},
    {[](const Shares& shares) { return shares.MostForcesAre(kBeyondRange); },
     "specific force exceeds 500 m/s^2 in most samples: is ",
     " in mm/s^2, or in counts of the sensor? ", "Convert it to m/s^2"},
    {[](const Shares& shares) { return shares.MostForcesAre(kFarBelowGravity); },
     "specific force on ",
     " lacks gravity: ", "publish raw accelerometer readings, including gravity"},
    {[](const Shares& shares) { return shares.OfGyro(kFastTurn) >= kMany && shares.is_long; },
     "angular velocity exceeds 4 rad/s in many samples: is ", " in deg/s? ",
     "Multiply it by pi/180, to rad/s"},
};

bool IsPresent(const Eigen::Vector3d& reading) {
  return reading.allFinite() && !reading.isZero(0.0);
}

bool IsNear(double value, double expected) {
  return value > (1 - kTolerance) * expected && value < (1 + kTolerance) * expected;
}

}  // namespace

void ImuContent::Add(const ImuSample& sample) {
  if (samples_++ == 0) first_ns_ = newest_ns_ = sample.t_ns;
  const double forgotten =
      std::clamp(ToSeconds(sample.t_ns - newest_ns_) / kMemory, 0.0, kMaxForgotten);
  newest_ns_ = std::max(newest_ns_, sample.t_ns);
  Eigen::Array<double, 10, 1> has = Eigen::Array<double, 10, 1>::Zero();
  has[kAny] = 1;
  has[kHasGyro] = IsPresent(sample.gyro);
  has[kHasAccel] = IsPresent(sample.accel);
  has[kHasBoth] = has[kHasGyro] * has[kHasAccel];
  if (has[kHasGyro] > 0) has[kFastTurn] = sample.gyro.norm() > kFastTurnRate;
  if (has[kHasAccel] > 0) {
    const double force = sample.accel.norm();
    has[kNearOneG] = IsNear(force, 1);
    has[kNearThousandMg] = IsNear(force, 1000);
    has[kNearGravity] = IsNear(force, gravity_norm_);
    has[kFarBelowGravity] = force < kFarBelow * gravity_norm_;
    has[kBeyondRange] = force > kAnyImuRange.accel;
  }
  AddForgetting(forgotten, has, &numbers_);
}

std::string ImuContent::Finding(const std::string& topic) const {
  if (samples_ < kMinSamples) return "";
  const Shares shares{numbers_, newest_ns_ - first_ns_ > kMinSpan_ns};
  for (const Test& test : kTests) {
    if (test.fails(shares)) return test.before_topic + topic + test.after_topic + test.advice;
  }
  return "";
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_content.h"

#include <algorithm>
#include <iterator>

#include "common/imu/imu_sensor.h"
#include "common/statistics.h"

namespace plm_vins {
namespace {

constexpr int64_t kMinSamples = 200;
constexpr int64_t kMinSpan_ns = 2'000'000'000;
constexpr double kMemory = 10;         // [s]
constexpr double kMaxForgotten = 0.1;  // by a gap
constexpr double kMinTested = 100;     // samples

constexpr double kNormTolerance = 0.3;  // relative, of a norm near that of gravity
constexpr double kFarBelow = 0.3;       // largest share of gravity that is far below it
constexpr double kFastTurn = 4.0;  // [rad/s]; agile flights exceed it in a few samples of a hundred

struct Reading {
  bool gyro = false, accel = false;  // not zero, and finite
  double rate = 0, force = 0;        // norms, if so
  double gravity = 0;
  // Whether each axis reads the same as in the last sample.
  Eigen::Array<bool, 3, 1> gyro_same, accel_same;
};

bool IsPresent(const Eigen::Vector3d& reading) {
  return reading.allFinite() && !reading.isZero(0.0);
}

bool IsNear(double value, double expected) {
  return value > (1 - kNormTolerance) * expected && value < (1 + kNormTolerance) * expected;
}

bool IsAny(const Reading&) { return true; }
bool HasGyro(const Reading& reading) { return reading.gyro; }
bool HasAccel(const Reading& reading) { return reading.accel; }
bool Turns(const Reading& reading) { return reading.gyro && reading.rate > kMostStandingRate; }
// In motion, and not a repeated reading.
bool HasNewGyro(const Reading& reading) { return Turns(reading) && !reading.gyro_same.all(); }
bool HasNewAccel(const Reading& reading) { return Turns(reading) && !reading.accel_same.all(); }

// A test fails if more than a share of the samples to which it applies are wrong.
struct Test {
  bool (*applies)(const Reading& reading);
  bool (*is_wrong)(const Reading& reading);
  double share;
  const char* text;  // with the topic, and what to do
};

constexpr char kGyroStuck[] =
    "one axis of the angular velocity on TOPIC never changes: the gyro or its driver does not "
    "measure it; three axes are needed";
constexpr char kAccelStuck[] =
    "one axis of the specific force on TOPIC never changes: the accelerometer or its driver does "
    "not measure it; three axes are needed";

// The most serious one first. A gyroscope that is simulated without noise reads zero during
// standstill.
constexpr Test kTests[] = {
    {IsAny, [](const Reading& r) { return !r.gyro && !r.accel; }, 0.99,
     "every sample on TOPIC is zero or NaN: the driver cannot read the IMU; check its log and the "
     "connection"},
    {IsAny, [](const Reading& r) { return !r.accel; }, 0.99,
     "specific force is zero or NaN in every sample: is TOPIC the gyro's own topic? Unite both "
     "sensors (unite_imu_method of the driver)"},
    {IsAny, [](const Reading& r) { return !r.gyro; }, 0.99,
     "angular velocity is zero or NaN in every sample: is TOPIC the accelerometer's own topic? "
     "Unite both sensors (unite_imu_method of the driver)"},
    {IsAny, [](const Reading& r) { return r.gyro != r.accel; }, 0.95,
     "gyro and accelerometer readings alternate on TOPIC: unite them in one message "
     "(unite_imu_method of the driver)"},
    {HasAccel, [](const Reading& r) { return IsNear(r.force, 1); }, 0.8,
     "specific force on TOPIC seems to be in g: multiply it by 9.81, to m/s^2"},
    {HasAccel, [](const Reading& r) { return IsNear(r.force, 1000); }, 0.8,
     "specific force on TOPIC seems to be in mg: multiply it by 0.00981, to m/s^2"},
    {HasAccel, [](const Reading& r) { return r.force > kAnyImuRange.accel; }, 0.8,
     "specific force exceeds 500 m/s^2 in most samples: is TOPIC in mm/s^2, or in counts of the "
     "sensor? Convert it to m/s^2"},
    {HasAccel, [](const Reading& r) { return r.force < kFarBelow * r.gravity; }, 0.8,
     "specific force on TOPIC lacks gravity: publish raw accelerometer readings, including "
     "gravity"},
    {HasGyro, [](const Reading& r) { return r.rate > kFastTurn; }, 0.3,
     "angular velocity exceeds 4 rad/s in many samples: is TOPIC in deg/s? Multiply it by pi/180, "
     "to rad/s"},
    {HasNewGyro, [](const Reading& r) { return r.gyro_same[0]; }, 0.999, kGyroStuck},
    {HasNewGyro, [](const Reading& r) { return r.gyro_same[1]; }, 0.999, kGyroStuck},
    {HasNewGyro, [](const Reading& r) { return r.gyro_same[2]; }, 0.999, kGyroStuck},
    {HasNewAccel, [](const Reading& r) { return r.accel_same[0]; }, 0.999, kAccelStuck},
    {HasNewAccel, [](const Reading& r) { return r.accel_same[1]; }, 0.999, kAccelStuck},
    {HasNewAccel, [](const Reading& r) { return r.accel_same[2]; }, 0.999, kAccelStuck},
};
static_assert(std::size(kTests) == ImuContent::kTestCount);

}  // namespace

void ImuContent::Add(const ImuSample& sample) {
  if (samples_++ == 0) first_ns_ = newest_ns_ = sample.t_ns;
  const double forgotten =
      std::clamp(ToSeconds(sample.t_ns - newest_ns_) / kMemory, 0.0, kMaxForgotten);
  newest_ns_ = std::max(newest_ns_, sample.t_ns);
  const Reading reading{IsPresent(sample.gyro),
                        IsPresent(sample.accel),
                        sample.gyro.norm(),
                        sample.accel.norm(),
                        gravity_norm_,
                        last_.gyro.array() == sample.gyro.array(),
                        last_.accel.array() == sample.accel.array()};
  last_ = sample;
  for (int i = 0; i < kTestCount; ++i) {
    if (!kTests[i].applies(reading)) continue;
    AddForgetting(forgotten, 1.0, &samples_of_[i]);
    AddForgetting(forgotten, kTests[i].is_wrong(reading) ? 1.0 : 0.0, &wrong_[i]);
  }
}

std::string ImuContent::Finding(const std::string& topic) const {
  if (samples_ < kMinSamples || newest_ns_ - first_ns_ < kMinSpan_ns) return "";
  for (int i = 0; i < kTestCount; ++i) {
    const bool is_wrong =
        samples_of_[i] > kMinTested && wrong_[i] > kTests[i].share * samples_of_[i];
    if (!is_wrong) continue;
    std::string text = kTests[i].text;
    return text.replace(text.find("TOPIC"), 5, topic);
  }
  return "";
}

}  // namespace plm_vins

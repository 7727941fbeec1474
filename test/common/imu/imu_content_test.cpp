// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_content.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace plm_vins {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kGravity = 9.81;
constexpr double kRate = 200;  // [Hz]

// A hand that turns the sensor by up to 0.5 rad/s and shakes it by 2 m/s^2.
ImuSample InHand(int i) {
  const double t = i / kRate;
  ImuSample sample{static_cast<int64_t>(1e9 * t)};
  sample.gyro = {0.5 * std::sin(2 * t), 0.3 * std::cos(3 * t), 0.1 * std::cos(4 * t)};
  sample.accel = {2 * std::sin(5 * t), 2 * std::cos(4 * t), kGravity + 0.5 * std::sin(7 * t)};
  return sample;
}

// Returns the finding of five seconds of samples, each as `change` makes it.
std::string FindingOf(const std::function<void(int, ImuSample*)>& change, int samples = 1000) {
  ImuContent content(kGravity);
  for (int i = 0; i < samples; ++i) {
    ImuSample sample = InHand(i);
    change(i, &sample);
    content.Add(sample);
  }
  return content.Finding("/imu");
}

TEST(ImuContent, AcceptsWorkingSensors) {
  EXPECT_THAT(FindingOf([](int, ImuSample*) {}), IsEmpty());
  EXPECT_THAT(FindingOf([](int i, ImuSample* sample) {  // single readings that failed
                if (i % 50 == 0) sample->gyro.setZero();
                if (i % 40 == 0) sample->accel.setZero();
              }),
              IsEmpty());
  EXPECT_THAT(FindingOf([](int, ImuSample* sample) { sample->gyro *= 5; }), IsEmpty());
  EXPECT_THAT(FindingOf([](int, ImuSample* sample) { sample->accel *= 1.2; }), IsEmpty());
}

TEST(ImuContent, DetectsAMissingSensor) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double nothing : {0.0, nan}) {
    EXPECT_THAT(
        FindingOf([&](int, ImuSample* sample) { sample->gyro.setConstant(nothing); }),
        HasSubstr("angular velocity is zero or NaN in every sample: is /imu the accelerometer's"));
    EXPECT_THAT(
        FindingOf([&](int, ImuSample* sample) { sample->accel.setConstant(nothing); }),
        HasSubstr("specific force is zero or NaN in every sample: is /imu the gyro's own topic?"));
  }
  EXPECT_THAT(FindingOf([](int, ImuSample* sample) { *sample = {sample->t_ns}; }),
              HasSubstr("every sample on /imu is zero or NaN"));
}

TEST(ImuContent, DetectsAlternatingSensors) {
  for (const int turns : {2, 4}) {
    EXPECT_THAT(FindingOf([&](int i, ImuSample* sample) {
                  (i % turns == 0 ? sample->gyro : sample->accel).setZero();
                }),
                HasSubstr("gyro and accelerometer readings alternate on /imu"));
  }
}

TEST(ImuContent, DetectsWrongUnits) {
  EXPECT_THAT(FindingOf([](int, ImuSample* sample) { sample->accel /= kGravity; }),
              HasSubstr("specific force on /imu seems to be in g"));
  EXPECT_THAT(FindingOf([](int, ImuSample* sample) { sample->accel *= 1000 / kGravity; }),
              HasSubstr("seems to be in mg"));
  for (const double factor : {1000.0, 16384 / kGravity}) {
    EXPECT_THAT(FindingOf([&](int, ImuSample* sample) { sample->accel *= factor; }),
                HasSubstr("is /imu in mm/s^2, or in counts of the sensor?"));
  }
  EXPECT_THAT(FindingOf([](int, ImuSample* sample) { sample->gyro *= 180 / M_PI; }),
              HasSubstr("is /imu in deg/s?"));
}

// Samples of 50 Hz, sent at 200 Hz.
void Repeat(int i, ImuSample* sample) {
  const int64_t t_ns = sample->t_ns;
  *sample = InHand(i - i % 4);
  sample->t_ns = t_ns;
}

TEST(ImuContent, DetectsAStuckAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double value : {0.0, 0.02}) {
      EXPECT_THAT(FindingOf([&](int, ImuSample* sample) { sample->gyro[axis] = value; }),
                  HasSubstr("one axis of the angular velocity on /imu never changes"));
    }
    EXPECT_THAT(FindingOf([&](int i, ImuSample* sample) {
                  Repeat(i, sample);
                  sample->gyro[axis] = 0;
                }),
                HasSubstr("one axis of the angular velocity on /imu never changes"));
    EXPECT_THAT(FindingOf([&](int, ImuSample* sample) { sample->accel[axis] = 5; }),
                HasSubstr("one axis of the specific force on /imu never changes"));
  }
}

// Also a sensor of low resolution at standstill.
TEST(ImuContent, AcceptsReadingsThatRepeat) {
  EXPECT_THAT(FindingOf(Repeat), IsEmpty());
  EXPECT_THAT(FindingOf([](int i, ImuSample* sample) {
                sample->gyro = {i % 7 == 0 ? 0.01 : 0.0, 0.02, -0.01};
                sample->accel = {i % 5 == 0 ? 0.1 : 0.0, 0, kGravity};
              }),
              IsEmpty());
}

TEST(ImuContent, DetectsRemovedGravity) {
  EXPECT_THAT(FindingOf([](int, ImuSample* sample) { sample->accel.z() -= kGravity; }),
              HasSubstr("specific force on /imu lacks gravity"));
}

// A driver that is started again, or a cable that is put in again.
TEST(ImuContent, FaultsPass) {
  const std::vector<std::function<void(ImuSample*)>> faults = {
      [](ImuSample* sample) { *sample = {sample->t_ns}; },
      [](ImuSample* sample) { sample->gyro.setZero(); },
      [](ImuSample* sample) { sample->accel /= kGravity; },
      [](ImuSample* sample) { sample->gyro *= 180 / M_PI; }};
  for (size_t k = 0; k < faults.size(); ++k) {
    const auto until_20_s = [&](int i, ImuSample* sample) {
      if (i < 4000) faults[k](sample);
    };
    EXPECT_NE(FindingOf(until_20_s, 4000), "") << k;
    EXPECT_EQ(FindingOf(until_20_s, 8000), "") << k;
  }
}

TEST(ImuContent, WaitsForEnoughSamples) {
  EXPECT_THAT(FindingOf([](int, ImuSample* sample) { sample->gyro.setZero(); }, 250), IsEmpty());
}

}  // namespace
}  // namespace plm_vins

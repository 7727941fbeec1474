// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_clipping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace plm_vins {
namespace {

constexpr ImuRange kConfigured;
constexpr double kTwoG = 2 * 9.80665;        // [m/s^2]
constexpr double k250 = 250 / 180.0 * M_PI;  // [rad/s]
constexpr double kGyroStep = k250 / 32768;   // resolution of 16 bits
constexpr double kAccelStep = kTwoG / 32768;

// Returns the range of ten seconds of agile flight with a vibration [m/s^2], each sample as
// `change` makes it.
ImuRange RangeOf(double vibration, const std::function<void(int, ImuSample*)>& change) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  ImuClipping clipping;
  for (int i = 0; i < 2000; ++i) {
    const double t = i / 200.0;
    ImuSample sample{static_cast<int64_t>(1e9 * t)};
    sample.gyro = {6 * std::sin(3 * t) + 0.01 * noise(random), std::cos(2 * t), 0.01};
    sample.accel = {0.02 * noise(random), 3 * std::sin(2 * t) + 0.02 * noise(random),
                    9.81 + vibration * std::sin(590 * t) + 0.02 * noise(random)};
    change(i, &sample);
    clipping.Add(sample);
  }
  return clipping.Range(kConfigured);
}

Eigen::Vector3d Clipped(const Eigen::Vector3d& reading, double end) {
  return reading.cwiseMin(end).cwiseMax(-end);
}

void Clip(ImuSample* sample) {
  sample->gyro = Clipped(sample->gyro, k250);
  sample->accel = Clipped(sample->accel, kTwoG);
}

Eigen::Vector3d Rounded(const Eigen::Vector3d& reading, double step) {
  return step * (reading / step).array().round().matrix();
}

void Round(double gyro_step, double accel_step, ImuSample* sample) {
  sample->gyro = Rounded(sample->gyro, gyro_step);
  sample->accel = Rounded(sample->accel, accel_step);
}

void ExpectConfigured(const ImuRange& range) {
  EXPECT_EQ(range.gyro, kConfigured.gyro);
  EXPECT_EQ(range.accel, kConfigured.accel);
}

TEST(ImuClipping, FindsTheEndOfTheRange) {
  for (const bool rounds : {false, true}) {
    const ImuRange range = RangeOf(20, [&](int, ImuSample* sample) {
      if (rounds) Round(kGyroStep, kAccelStep, sample);
      Clip(sample);
    });
    EXPECT_EQ(range.gyro, k250);
    EXPECT_EQ(range.accel, kTwoG);
  }
}

TEST(ImuClipping, FindsTheEndOfOneDirection) {
  EXPECT_EQ(RangeOf(5,
                    [](int, ImuSample* sample) {
                      sample->gyro.x() = std::max(sample->gyro.x() - 3, -k250);
                    })
                .gyro,
            k250);
}

TEST(ImuClipping, AcceptsUnclippedReadings) {
  for (const double vibration : {0.0, 20.0}) {
    ExpectConfigured(RangeOf(vibration, [](int, ImuSample*) {}));
    for (const double step : {1e-3, 0.02, 0.1, 0.5}) {
      ExpectConfigured(
          RangeOf(vibration, [&](int, ImuSample* sample) { Round(step, step, sample); }));
    }
  }
}

// A vibration whose peaks are equal, without noise, at several resolutions.
TEST(ImuClipping, AcceptsPeaksOfASine) {
  for (const double step : {1e-3, 0.1, 0.3, 1.0}) {
    ExpectConfigured(RangeOf(0, [&](int i, ImuSample* sample) {
      sample->accel = {0.1 * i, 0, 20 * std::sin(0.7 * i)};
      sample->gyro = {1e-3 * i, 0, 4 * std::sin(0.01 * i)};
      Round(0.1 * step, step, sample);
    }));
  }
}

TEST(ImuClipping, AcceptsRepeatedSamples) {
  ExpectConfigured(RangeOf(0, [](int i, ImuSample* sample) {
    if (i > 1000) sample->gyro = {20, 0, 0};
    if (i > 1000) sample->accel = {0, 0, 30};
  }));
}

TEST(ImuClipping, LargerReadingsDisproveIt) {
  const ImuRange range = RangeOf(20, [](int i, ImuSample* sample) {
    if (i < 1900) Clip(sample);
  });
  ExpectConfigured(range);
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace plm_vins {
namespace {

constexpr int64_t kStep_ns = 5'000'000;

// A flight with a slow rotation and propellers that shake the accelerometer by 5 m/s^2 from sample
// to sample.
std::vector<ImuSample> Flight(int count, int64_t step_ns = kStep_ns) {
  std::vector<ImuSample> samples;
  for (int i = 0; i < count; ++i) {
    const double shake = i % 2 == 0 ? 2.5 : -2.5;
    samples.push_back({i * step_ns, {0.01 * i, 0, 0}, {shake, 0, 9.81}});
  }
  return samples;
}

struct Decided {
  std::vector<ImuSample> samples;
  int64_t replaced = 0;
  int64_t saturated = 0;
};

Decided Pass(const std::vector<ImuSample>& samples, const ImuSensor& sensor = ImuSensor()) {
  ImuGate gate(sensor);
  Decided decided;
  for (const ImuSample& sample : samples) {
    for (const ImuSample& next : gate.Add(sample)) decided.samples.push_back(next);
  }
  decided.replaced = gate.replaced();
  decided.saturated = gate.saturated();
  return decided;
}

void ExpectUntouched(const std::vector<ImuSample>& samples) {
  const Decided decided = Pass(samples);
  EXPECT_EQ(decided.replaced, 0);
  ASSERT_EQ(decided.samples.size(), samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(decided.samples[i].t_ns, samples[i].t_ns);
    EXPECT_EQ(decided.samples[i].gyro, samples[i].gyro);
    EXPECT_EQ(decided.samples[i].accel, samples[i].accel);
    EXPECT_EQ(decided.samples[i].accel_doubt, 0);
  }
}

TEST(ImuGate, DoesNotChangeAFlight) { ExpectUntouched(Flight(200)); }

TEST(ImuGate, InterpolatesASpikeFromItsNeighbors) {
  std::vector<ImuSample> samples = Flight(200);
  samples[100].accel.y() = 150;
  const Decided decided = Pass(samples);
  ASSERT_EQ(decided.samples.size(), samples.size());
  EXPECT_EQ(decided.replaced, 1);
  const ImuSample& replaced = decided.samples[100];
  EXPECT_EQ(replaced.t_ns, samples[100].t_ns);
  EXPECT_NEAR(replaced.gyro.x(), samples[100].gyro.x(), 1e-12);
  EXPECT_TRUE(replaced.accel.isApprox(samples[99].accel));
  EXPECT_NEAR(replaced.accel_doubt, 150, 1e-9);
  EXPECT_NEAR(replaced.gyro_doubt, 0, 1e-12);
  EXPECT_EQ(decided.samples[101].accel, samples[101].accel);
}

TEST(ImuGate, ReplacesAFewConsecutiveSpikes) {
  std::vector<ImuSample> samples = Flight(200);
  for (int i = 100; i < 100 + ImuGate::kMaxRun; ++i) samples[i].gyro.z() = -30;
  const Decided decided = Pass(samples);
  EXPECT_EQ(decided.replaced, ImuGate::kMaxRun);
  for (int i = 100; i < 100 + ImuGate::kMaxRun; ++i) {
    EXPECT_NEAR(decided.samples[i].gyro.x(), samples[i].gyro.x(), 1e-12);
    EXPECT_EQ(decided.samples[i].gyro.z(), 0);
    EXPECT_NEAR(decided.samples[i].gyro_doubt, 30, 1e-9);
  }
}

TEST(ImuGate, AcceptsALastingStepAtAnyRate) {
  for (const int64_t step_ns : {kStep_ns, 2 * kStep_ns, 8 * kStep_ns}) {
    std::vector<ImuSample> samples = Flight(200, step_ns);
    for (size_t i = 100; i < samples.size(); ++i) samples[i].gyro.z() = 10;
    ExpectUntouched(samples);
  }
}

TEST(ImuGate, AcceptsLastingVibration) {
  std::vector<ImuSample> samples = Flight(1000);
  for (size_t i = 100; i < samples.size(); ++i) samples[i].accel.x() = i % 2 == 0 ? 30 : -30;
  const Decided decided = Pass(samples);
  EXPECT_GT(decided.replaced, 0);
  EXPECT_LT(decided.replaced, 50);  // at most half a second
}

TEST(ImuGate, OneSpikeASecondHardlyWidensTheGate) {
  std::vector<ImuSample> samples = Flight(2000);
  for (size_t i = 100; i < samples.size(); i += 200) samples[i].accel.y() = 80;
  EXPECT_EQ(Pass(samples).replaced, 10);
}

TEST(ImuGate, NeverAcceptsASpikeBeyondTheRange) {
  std::vector<ImuSample> samples = Flight(10);
  samples[0].gyro.x() = 3;  // there is no previous reading
  EXPECT_EQ(Pass(samples).replaced, 0);
  const ImuRange two_turns{2, 160};
  const Decided decided = Pass(samples, ImuSensor{two_turns});
  EXPECT_EQ(decided.replaced, 1);
  EXPECT_EQ(decided.samples[0].t_ns, 0);
  EXPECT_EQ(decided.samples[0].gyro, samples[1].gyro);
  EXPECT_NEAR(decided.samples[0].gyro_doubt, two_turns.gyro - samples[1].gyro.x(), 1e-12);
}

TEST(ImuGate, RaisesTheNoiseOfSaturatedReadings) {
  std::vector<ImuSample> samples = Flight(200);
  for (size_t i = 100; i < 110; ++i) samples[i].gyro.z() = -34.9;  // 2000 deg/s
  const Decided decided = Pass(samples);
  EXPECT_EQ(decided.saturated, 10);
  EXPECT_EQ(decided.samples[105].gyro.z(), -34.9);
  EXPECT_EQ(decided.samples[105].gyro_doubt, 17.5);
  EXPECT_EQ(decided.samples[105].accel_doubt, 0);
  EXPECT_EQ(decided.samples[99].gyro_doubt, 0);
  EXPECT_EQ(decided.samples[115].gyro_doubt, 0);
}

TEST(ImuGate, SpikeAmongSaturatedReadingsKeepsItsRaisedNoise) {
  std::vector<ImuSample> samples = Flight(200);
  for (size_t i = 100; i < 120; ++i) samples[i].gyro.z() = 34.9;
  samples[110].gyro.z() = -34.9;  // a flipped sign bit
  const Decided decided = Pass(samples);
  EXPECT_EQ(decided.replaced, 1);
  EXPECT_EQ(decided.saturated, 19);
  EXPECT_NEAR(decided.samples[110].gyro.z(), 34.9, 1e-12);
  EXPECT_NEAR(decided.samples[110].gyro_doubt, 69.8, 1e-12);
}

TEST(ImuGate, DoesNotCompareAcrossAGap) {
  std::vector<ImuSample> samples = Flight(200);
  for (size_t i = 100; i < samples.size(); ++i) {
    samples[i].t_ns += 100'000'000;
    samples[i].gyro.z() = 10;
  }
  ImuGate gate{ImuSensor()};
  for (const ImuSample& sample : samples) EXPECT_EQ(gate.Add(sample).size(), 1u);
  samples[101].gyro.z() = 11.2;
  EXPECT_EQ(Pass(samples).replaced, 1) << "a gap's rotation is no typical difference";
}

TEST(ImuGate, CorrectsAcceptedReadings) {
  ImuSensor sensor;
  sensor.gyro_correction << 0, -2, 0, 1, 0, 0, 0, 0, 1;
  sensor.accel_correction << 0.5, 0, 0, 0, 1, 0, 0, 0.25, 2;
  const std::vector<ImuSample> samples = {{0, {1, 2, 3}, {4, 8, 2}},
                                          {kStep_ns, {1, 2, 30}, {4, 8, 2}},
                                          {2 * kStep_ns, {1, 2, 3}, {4, 8, 2}}};
  const Decided decided = Pass(samples, sensor);
  ASSERT_EQ(decided.samples.size(), 3u);  // the second one is replaced
  for (const ImuSample& sample : decided.samples) {
    EXPECT_EQ(sample.gyro, Eigen::Vector3d(-4, 1, 3));
    EXPECT_EQ(sample.accel, Eigen::Vector3d(2, 8, 6));
  }
}

// A gyro of 250 deg/s whose range is not configured.
TEST(ImuGate, FindsTheRangeWhereReadingsAreClipped) {
  constexpr double kEnd = 4.36;
  std::vector<ImuSample> samples = Flight(2000);
  for (size_t i = 0; i < samples.size(); ++i) {
    const double rate = 6 * std::sin(0.015 * static_cast<double>(i));
    samples[i].gyro.x() = 0.001 * static_cast<double>(i);
    samples[i].gyro.y() = std::min(std::max(rate, -kEnd), kEnd);
  }
  ImuGate gate{ImuSensor()};
  std::vector<ImuSample> decided;
  for (const ImuSample& sample : samples) {
    for (const ImuSample& next : gate.Add(sample)) decided.push_back(next);
  }
  EXPECT_NE(gate.Clipping().find("the gyro ends at 4.36 rad/s"), std::string::npos);
  EXPECT_GT(gate.saturated(), 500);
  ASSERT_EQ(decided.size(), samples.size());
  for (size_t i = 1000; i < decided.size(); ++i) {
    EXPECT_EQ(decided[i].gyro_doubt > 1, std::abs(decided[i].gyro.y()) > 0.98 * kEnd) << i;
    EXPECT_EQ(decided[i].accel_doubt, 0);
  }
}

// A reading that a correction makes smaller is saturated all the same.
TEST(ImuGate, RangeRefersToRawReadings) {
  ImuSensor sensor;
  sensor.gyro_correction *= 0.9;
  const Decided decided = Pass({{0, {0, 0, 34.9}, {0, 0, 9.81}}}, sensor);
  ASSERT_EQ(decided.samples.size(), 1u);
  EXPECT_EQ(decided.saturated, 1);
  EXPECT_NEAR(decided.samples[0].gyro.z(), 0.9 * 34.9, 1e-12);
  EXPECT_GT(decided.samples[0].gyro_doubt, 0);
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_door.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

constexpr int64_t kMs = 1'000'000;
constexpr int64_t kMinute_ms = 60'000;
using Stamps = std::vector<int64_t>;
using Clocks = std::vector<ClockChange>;

// A reading that is linear in time, and small at any timestamp used here.
ImuSample Reading(int64_t t_ms) {
  return {t_ms * kMs, {1e-6 * static_cast<double>(t_ms), 0, 0}, {0, 9.81, 0}};
}

class ImuDoorTest : public ::testing::Test {
 protected:
  // Adds samples every 5 ms in [begin, end] (ms). Returns the changes of the clock after each.
  Clocks Add(int64_t begin_ms, int64_t end_ms) {
    Clocks clocks;
    for (int64_t t = begin_ms; t <= end_ms; t += 5) clocks.push_back(Add(Reading(t)));
    return clocks;
  }
  ClockChange Add(const ImuSample& sample) {
    const AdmittedImu admitted = door_.Add(sample);
    if (admitted.clock != ClockChange::kNone) admitted_.clear();
    for (const ImuSample& next : admitted.samples) admitted_.push_back(next);
    return admitted.clock;
  }
  Stamps Milliseconds() const {
    Stamps stamps;
    for (const ImuSample& sample : admitted_) stamps.push_back(sample.t_ns / kMs);
    return stamps;
  }

  ImuDoor door_{ImuSensor()};
  std::vector<ImuSample> admitted_;  // by the present clock
};

TEST_F(ImuDoorTest, AdmitsUsableSamplesInOrder) {
  Add(0, 10);
  ImuSample bad = Reading(15);
  bad.accel.z() = std::numeric_limits<double>::infinity();
  Add(bad);
  Add({16 * kMs, {0, 0, 0}, {0, 0, 0}});
  Add({17 * kMs, {0, 0, 0}, {1e6, 0, 9.81}});
  Add({kEndOfTime_ns, {0, 0, 0}, {0, 9.81, 0}});
  Add(Reading(10));
  Add(Reading(5));
  Add(20, 25);
  EXPECT_EQ(Milliseconds(), (Stamps{0, 5, 10, 20, 25}));
  EXPECT_EQ(door_.statistics().imu_not_finite, 1);
  EXPECT_EQ(door_.statistics().imu_implausible, 3);
  EXPECT_EQ(door_.statistics().imu_out_of_order, 2);
}

// The next sample decides about it.
TEST_F(ImuDoorTest, TheSampleAfterAGapWaitsForTheNext) {
  Add(0, 10);
  Add(100, 100);
  EXPECT_EQ(Milliseconds(), (Stamps{0, 5, 10}));
  Add(105, 105);
  EXPECT_EQ(Milliseconds(), (Stamps{0, 5, 10, 100, 105}));
  EXPECT_EQ(door_.statistics().imu_gaps, 1);
  Add(3600'000, 3600'000);  // alone in the future
  Add(110, 115);
  EXPECT_EQ(Milliseconds(), (Stamps{0, 5, 10, 100, 105, 110, 115}));
  EXPECT_EQ(door_.statistics().imu_out_of_order, 1);
}

TEST_F(ImuDoorTest, RepeatedReadingsInMotionLeaveAGap) {
  const auto add = [&](int64_t t_ms, int64_t reading_ms) {
    ImuSample sample = Reading(reading_ms);
    sample.t_ns = t_ms * kMs;
    sample.gyro.y() = 0.3;
    Add(sample);
  };
  Stamps expected;
  for (int64_t t = 0; t <= 2200; t += 5) {
    const bool is_stuck = t > 1000 && t <= 2000;
    add(t, is_stuck ? 1000 : t);
    if (!is_stuck || t <= 1050) expected.push_back(t);
  }
  EXPECT_EQ(Milliseconds(), expected);
  EXPECT_EQ(door_.statistics().imu_stuck, 190);
  EXPECT_EQ(door_.statistics().imu_gaps, 1);
  EXPECT_EQ(door_.statistics().first_imu_stuck,
            "the same reading from 1.000 s on: check the connection of the IMU, and its driver");
}

TEST_F(ImuDoorTest, AdmitsRepeatedReadingsAtStandstill) {
  Add(0, 1000);
  for (int64_t t = 1005; t <= 2000; t += 5) Add({t * kMs, {0.01, 0, 0}, {0, 0.1, 9.81}});
  EXPECT_EQ(admitted_.size(), 401u);
}

TEST_F(ImuDoorTest, AdmitsAConstantRateWithoutNoise) {
  for (int64_t t = 0; t <= 1000; t += 5) Add({t * kMs, {0, 0, 1}, {0, 0, 9.81}});
  EXPECT_EQ(admitted_.size(), 201u);
}

TEST_F(ImuDoorTest, ReplacesOutliersAndCorrectsReadings) {
  ImuSensor sensor;
  sensor.accel_correction << 0, -1.05, 0, 0.95, 0, 0, 0, 0, 1;
  door_ = ImuDoor(sensor);
  for (int64_t t = 0; t <= 200; t += 5) {
    ImuSample sample = Uncorrected(Reading(t), sensor);
    if (t == 100) sample.accel.x() = 150;
    Add(sample);
    EXPECT_EQ(Milliseconds().back(), t == 100 ? 95 : t);
  }
  EXPECT_EQ(admitted_.size(), 41u);
  for (const ImuSample& sample : admitted_) {
    EXPECT_MATRIX_NEAR(sample.accel, Reading(0).accel, 1e-9);
    EXPECT_EQ(sample.accel_doubt > 0, sample.t_ns == 100 * kMs);
  }
  EXPECT_EQ(door_.statistics().imu_replaced, 1);
}

TEST_F(ImuDoorTest, SpreadsBursts) {
  constexpr int64_t kBurst = 8;
  for (int64_t i = 0; i < 800; ++i) {
    ImuSample sample = Reading(5 * i);
    sample.t_ns = 5 * kMs * (i - i % kBurst + kBurst - 1);
    Add(sample);
  }
  EXPECT_EQ(door_.bursts().size(), 8u);
  ASSERT_GT(admitted_.size(), 500u);
  for (size_t i = admitted_.size() - 500; i < admitted_.size(); ++i) {
    EXPECT_NEAR(ToSeconds(admitted_[i].t_ns - admitted_[i - 1].t_ns), 0.005, 1e-3);
  }
}

TEST_F(ImuDoorTest, NoticesAStepBackOnceTheClockRunsOn) {
  Add(0, 1000);
  const Clocks clocks = Add(902, 1012);
  Clocks expected(clocks.size(), ClockChange::kNone);
  expected[20] = ClockChange::kBack;  // at 1002 ms
  EXPECT_EQ(clocks, expected);
  EXPECT_EQ(Milliseconds(), (Stamps{1002, 1007, 1012}));
}

TEST_F(ImuDoorTest, NoticesAReplayOnceItsPatienceEnds) {
  for (const int patience : {100, ImuDoor::kPatience}) {
    door_ = ImuDoor(ImuSensor(), patience);
    Add(100'000, 101'000);
    const Clocks clocks = Add(0, 6000);
    Clocks expected(clocks.size(), ClockChange::kNone);
    expected[patience] = ClockChange::kBack;
    EXPECT_EQ(clocks, expected);
    EXPECT_EQ(Milliseconds().front(), 5 * patience);
  }
}

TEST_F(ImuDoorTest, NoticesALeapAheadAtTheSecondSample) {
  for (const int64_t leap_ms : {kMinute_ms, kMinute_ms + 5}) {
    door_ = ImuDoor(ImuSensor());
    admitted_.clear();
    Add(0, 100);
    const bool is_leap = leap_ms > kMinute_ms;
    EXPECT_EQ(Add(100 + leap_ms, 110 + leap_ms),
              (Clocks{ClockChange::kNone, is_leap ? ClockChange::kForward : ClockChange::kNone,
                      ClockChange::kNone}));
    EXPECT_EQ(Milliseconds().front(), is_leap ? 100 + leap_ms : 0);
    EXPECT_EQ(door_.statistics().imu_gaps, is_leap ? 0 : 1);
  }
}

TEST_F(ImuDoorTest, ClearAcceptsAnyNextSampleAndKeepsTheCounts) {
  Add(1000, 1100);
  Add(900, 900);
  door_.Clear();
  for (const ClockChange clock : Add(0, 100)) EXPECT_EQ(clock, ClockChange::kNone);
  EXPECT_EQ(Milliseconds().back(), 100);
  EXPECT_EQ(door_.statistics().imu_out_of_order, 1);
}

}  // namespace
}  // namespace plm_vins

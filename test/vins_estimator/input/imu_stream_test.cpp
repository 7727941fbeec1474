// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/imu_stream.h"

#include <gtest/gtest.h>

#include <vector>

#include "test/vins_estimator/input/sync_input.h"

namespace plm_vins {
namespace {

using testing::kMs;
using Clock = ImuStream::Clock;

constexpr double kMaxGap = 0.05;
constexpr int64_t kMinute_ms = 60'000;

ImuStream Stream(int max_samples = 1000) { return {ImuSensor(), kMaxGap, max_samples}; }

// A reading that is linear in time, and small at any timestamp used here.
ImuSample Reading(int64_t t_ns) { return {t_ns, {1e-3 * ToSeconds(t_ns), 0, 0}, {0, 9.81, 0}}; }

// Adds samples every 5 ms in [begin, end] (ms). Returns the clock state after each of them.
std::vector<Clock> Add(ImuStream* stream, int64_t begin_ms, int64_t end_ms) {
  std::vector<Clock> clocks;
  for (int64_t t = begin_ms; t <= end_ms; t += 5) clocks.push_back(stream->Add(Reading(t * kMs)));
  return clocks;
}

std::vector<int64_t> Milliseconds(const std::vector<ImuSample>& samples) {
  std::vector<int64_t> stamps;
  for (const ImuSample& sample : samples) stamps.push_back(sample.t_ns / kMs);
  return stamps;
}

using Stamps = std::vector<int64_t>;

TEST(ImuStream, ReachesItsNewestSample) {
  ImuStream stream = Stream();
  EXPECT_FALSE(stream.Reaches(0));
  Add(&stream, 10, 50);
  EXPECT_EQ(stream.first_ns(), 10 * kMs);
  EXPECT_EQ(stream.newest_ns(), 50 * kMs);
  EXPECT_TRUE(stream.Reaches(50 * kMs));
  EXPECT_FALSE(stream.Reaches(50 * kMs + 1));
}

TEST(ImuStream, CutsIntervalsThatJoin) {
  ImuStream stream = Stream();
  Add(&stream, 0, 40);
  EXPECT_FALSE(stream.last_cut_ns());
  EXPECT_EQ(Milliseconds(stream.Cut(12 * kMs)), Stamps({0, 5, 10, 12}));
  EXPECT_EQ(stream.last_cut_ns(), 12 * kMs);
  EXPECT_EQ(stream.first_ns(), 12 * kMs);
  EXPECT_EQ(Milliseconds(stream.Cut(20 * kMs)), Stamps({12, 15, 20}));  // on a sample
  EXPECT_EQ(Milliseconds(stream.Cut(22 * kMs)), Stamps({20, 22}));
  EXPECT_EQ(Milliseconds(stream.Cut(24 * kMs)), Stamps({22, 24}));  // between the same two
  const std::vector<ImuSample> last = stream.Cut(40 * kMs);
  EXPECT_EQ(Milliseconds(last), Stamps({24, 25, 30, 35, 40}));
  EXPECT_TRUE(last.front().gyro.isApprox(Reading(24 * kMs).gyro, 1e-12));
}

TEST(ImuStream, TheFirstSampleMayBeCutAlone) {
  ImuStream stream = Stream();
  Add(&stream, 10, 50);
  EXPECT_EQ(Milliseconds(stream.Cut(10 * kMs)), Stamps({10}));
  EXPECT_EQ(Milliseconds(stream.Cut(20 * kMs)), Stamps({10, 15, 20}));
}

TEST(ImuStream, AGapHasNoEnds) {
  ImuStream stream = Stream();
  Add(&stream, 0, 100);
  Add(&stream, 200, 300);
  EXPECT_EQ(stream.statistics().imu_gaps, 1);
  for (const int64_t inside : {101, 150, 199}) EXPECT_TRUE(stream.IsInGap(inside * kMs));
  for (const int64_t outside : {0, 98, 100, 200, 202}) EXPECT_FALSE(stream.IsInGap(outside * kMs));
}

// The next sample decides about it.
TEST(ImuStream, TheSampleAfterAGapWaitsForTheNext) {
  ImuStream stream = Stream();
  Add(&stream, 0, 100);
  Add(&stream, 200, 200);
  EXPECT_EQ(stream.newest_ns(), 100 * kMs);
  Add(&stream, 205, 205);
  EXPECT_EQ(stream.newest_ns(), 205 * kMs);
}

TEST(ImuStream, TheBoundaryOfTheLastCutIsNotDropped) {
  ImuStream stream = Stream(10);
  Add(&stream, 0, 60);
  EXPECT_EQ(stream.first_ns(), 15 * kMs);
  EXPECT_EQ(stream.statistics().imu_dropped_full, 3);
  stream.Cut(20 * kMs);
  Add(&stream, 65, 100);
  EXPECT_EQ(stream.first_ns(), 20 * kMs);
  EXPECT_EQ(Milliseconds(stream.Cut(70 * kMs)), Stamps({20, 60, 65, 70}));
}

TEST(ImuStream, BackwardJumpIsReportedOnceTheClockRunsOn) {
  ImuStream stream = Stream();
  Add(&stream, 0, 1000);
  stream.Cut(500 * kMs);
  const std::vector<Clock> clocks = Add(&stream, 902, 1012);
  std::vector<Clock> expected(clocks.size(), Clock::kRunsOn);
  expected[20] = Clock::kSetBack;  // at 1002 ms
  EXPECT_EQ(clocks, expected);
  EXPECT_EQ(stream.first_ns(), 1002 * kMs);
  EXPECT_EQ(stream.newest_ns(), 1012 * kMs);
  EXPECT_FALSE(stream.last_cut_ns());
}

TEST(ImuStream, ReplayIsReportedAfterAThousandSamples) {
  ImuStream stream = Stream();
  Add(&stream, 100'000, 101'000);
  const std::vector<Clock> clocks = Add(&stream, 0, 6000);
  std::vector<Clock> expected(clocks.size(), Clock::kRunsOn);
  expected[1000] = Clock::kSetBack;
  EXPECT_EQ(clocks, expected);
  EXPECT_EQ(stream.first_ns(), 5000 * kMs);
}

TEST(ImuStream, ForwardJumpIsReportedAtTheSecondSample) {
  for (const int64_t leap_ms : {kMinute_ms, kMinute_ms + 5}) {
    ImuStream stream = Stream();
    Add(&stream, 0, 100);
    const std::vector<Clock> clocks = Add(&stream, 100 + leap_ms, 110 + leap_ms);
    const bool set_on = leap_ms > kMinute_ms;
    EXPECT_EQ(clocks, std::vector<Clock>({Clock::kRunsOn, set_on ? Clock::kSetOn : Clock::kRunsOn,
                                          Clock::kRunsOn}));
    EXPECT_EQ(stream.first_ns(), set_on ? (100 + leap_ms) * kMs : 0);
    EXPECT_EQ(stream.statistics().imu_gaps, set_on ? 0 : 1);
  }
}

TEST(ImuStream, ClearForgetsTimeAndKeepsTheCounts) {
  ImuStream stream = Stream();
  Add(&stream, 1000, 1100);
  EXPECT_EQ(stream.Add(Reading(900 * kMs)), Clock::kRunsOn);
  stream.Cut(1050 * kMs);
  stream.Clear();
  EXPECT_FALSE(stream.Reaches(0));
  EXPECT_FALSE(stream.last_cut_ns());
  for (const Clock clock : Add(&stream, 0, 100)) EXPECT_EQ(clock, Clock::kRunsOn);
  EXPECT_EQ(stream.first_ns(), 0);
  EXPECT_EQ(stream.statistics().imu_out_of_order, 1);
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/imu_stream.h"

#include <gtest/gtest.h>

#include <vector>

#include "test/vins_estimator/input/sync_input.h"

namespace plm_vins {
namespace {

using testing::kMs;

ImuStream Stream(int max_samples = 1000) { return {ImuSensor(), max_samples}; }

// A reading that is linear in time, and small at any timestamp used here.
ImuSample Reading(int64_t t_ns) { return {t_ns, {1e-3 * ToSeconds(t_ns), 0, 0}, {0, 9.81, 0}}; }

// Adds samples every 5 ms in [begin, end] (ms).
void Add(ImuStream* stream, int64_t begin_ms, int64_t end_ms) {
  for (int64_t t = begin_ms; t <= end_ms; t += 5) stream->Add(Reading(t * kMs));
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
  EXPECT_EQ(stream.door().statistics().imu_gaps, 1);
  for (const int64_t inside : {101, 150, 199}) EXPECT_TRUE(stream.IsInGap(inside * kMs));
  for (const int64_t outside : {0, 98, 100, 200, 202}) EXPECT_FALSE(stream.IsInGap(outside * kMs));
}

TEST(ImuStream, TheBoundaryOfTheLastCutIsNotDropped) {
  ImuStream stream = Stream(10);
  Add(&stream, 0, 60);
  EXPECT_EQ(stream.first_ns(), 15 * kMs);
  EXPECT_EQ(stream.dropped_full(), 3);
  stream.Cut(20 * kMs);
  Add(&stream, 65, 100);
  EXPECT_EQ(stream.first_ns(), 20 * kMs);
  EXPECT_EQ(Milliseconds(stream.Cut(70 * kMs)), Stamps({20, 60, 65, 70}));
}

TEST(ImuStream, StartsANewSequenceIfTheClockWasSet) {
  ImuStream stream = Stream();
  Add(&stream, 0, 1000);
  stream.Cut(500 * kMs);
  Add(&stream, 902, 1012);
  EXPECT_EQ(stream.first_ns(), 1002 * kMs);
  EXPECT_EQ(stream.newest_ns(), 1012 * kMs);
  EXPECT_FALSE(stream.last_cut_ns());
}

TEST(ImuStream, ClearForgetsTimeAndKeepsTheCounts) {
  ImuStream stream = Stream();
  Add(&stream, 1000, 1100);
  stream.Add(Reading(900 * kMs));
  stream.Cut(1050 * kMs);
  stream.Clear();
  EXPECT_FALSE(stream.Reaches(0));
  EXPECT_FALSE(stream.last_cut_ns());
  Add(&stream, 0, 100);
  EXPECT_EQ(stream.first_ns(), 0);
  EXPECT_EQ(stream.door().statistics().imu_out_of_order, 1);
}

}  // namespace
}  // namespace plm_vins

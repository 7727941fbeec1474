// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/match_schedule.h"

#include <gtest/gtest.h>

#include <vector>

#include "simulator/default_sensors.h"

namespace plm_vins {
namespace {

constexpr int64_t kMillisecond = 1'000'000;

// Returns the timestamps [ms] that are due in the second camera of a pair; in the first one all
// are.
std::vector<int> Due(double publish_rate, const std::vector<int>& stamps) {
  Config config;
  config.sensor = simulator::DefaultStereoSensors();
  config.publish_rate = publish_rate;
  MatchSchedule schedule(config);
  std::vector<int> due;
  for (const int t : stamps) {
    if (schedule.IsDue(1, t * kMillisecond)) due.push_back(t);
    EXPECT_TRUE(schedule.IsDue(0, t * kMillisecond));
  }
  return due;
}

TEST(MatchSchedule, SelectsEverySecondImageAtTwentyHertz) {
  EXPECT_EQ(Due(0, {0, 50, 100, 150, 201}), (std::vector<int>{0, 100, 201}));
}

TEST(MatchSchedule, SelectsEveryImageAtTenHertz) {
  EXPECT_EQ(Due(0, {0, 100, 199, 300}), (std::vector<int>{0, 100, 199, 300}));
}

TEST(MatchSchedule, LeavesTheSelectionToThePublishRate) {
  EXPECT_EQ(Due(10, {0, 50, 100}), (std::vector<int>{0, 50, 100}));
}

TEST(MatchSchedule, RestartsWhereTimestampsJumpBack) {
  EXPECT_EQ(Due(0, {1000, 1050, 0, 50, 100}), (std::vector<int>{1000, 0, 100}));
}

TEST(MatchSchedule, SelectsEveryImageOfACameraWithATracker) {
  Config config;
  config.sensor = simulator::DefaultStereoSensors();
  config.sensor.stereo_pairs = "none";
  MatchSchedule schedule(config);
  for (const int t : {0, 50, 100}) EXPECT_TRUE(schedule.IsDue(1, t * kMillisecond));
}

}  // namespace
}  // namespace plm_vins

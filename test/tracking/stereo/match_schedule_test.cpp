// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/match_schedule.h"

#include <gtest/gtest.h>

#include <vector>

namespace plm_vins {
namespace {

constexpr int64_t kMillisecond = 1'000'000;

// Returns the timestamps [ms] that are due.
std::vector<int> Due(double publish_rate, const std::vector<int>& stamps) {
  MatchSchedule schedule(publish_rate);
  std::vector<int> due;
  for (const int t : stamps) {
    if (schedule.IsDue(t * kMillisecond)) due.push_back(t);
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

}  // namespace
}  // namespace plm_vins

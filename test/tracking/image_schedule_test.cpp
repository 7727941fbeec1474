// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/image_schedule.h"

#include <gtest/gtest.h>

#include <vector>

namespace plm_vins {
namespace {

constexpr int64_t kScheduleMillisecond = 1'000'000;

// Returns the timestamps [ms] of the images that are needed of two further cameras; of camera 0 all
// are.
std::vector<int> Needed(double publish_rate, const std::vector<int>& stamps) {
  ImageSchedule schedule(publish_rate);
  std::vector<int> needed;
  for (const int t : stamps) {
    EXPECT_TRUE(schedule.IsNeeded(0, t * kScheduleMillisecond));
    const bool is_needed = schedule.IsNeeded(1, t * kScheduleMillisecond);
    EXPECT_EQ(schedule.IsNeeded(2, t * kScheduleMillisecond), is_needed);
    if (is_needed) needed.push_back(t);
  }
  return needed;
}

TEST(ImageSchedule, SelectsEverySecondImageAtTwentyHertz) {
  EXPECT_EQ(Needed(0, {0, 50, 100, 150, 201}), (std::vector<int>{0, 100, 201}));
}

TEST(ImageSchedule, SelectsEveryImageAtTenHertz) {
  EXPECT_EQ(Needed(0, {0, 100, 199, 300}), (std::vector<int>{0, 100, 199, 300}));
}

TEST(ImageSchedule, LeavesTheSelectionToThePublishRate) {
  EXPECT_EQ(Needed(10, {0, 50, 100}), (std::vector<int>{0, 50, 100}));
}

TEST(ImageSchedule, RestartsWhereTimestampsJumpBack) {
  EXPECT_EQ(Needed(0, {1000, 1050, 0, 50, 100}), (std::vector<int>{1000, 0, 100}));
}

}  // namespace
}  // namespace plm_vins

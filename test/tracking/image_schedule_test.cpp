// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/image_schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plm_vins {
namespace {

constexpr int64_t kOneMillisecond = 1'000'000;

// Returns the timestamps [ms] that are selected at `rate` [Hz].
std::vector<int> Take(double rate, const std::vector<int>& stamps) {
  RateLimiter limiter(rate);
  std::vector<int> taken;
  for (const int t : stamps) {
    if (limiter.Take(t * kOneMillisecond)) taken.push_back(t);
  }
  return taken;
}

TEST(RateLimiter, ZeroTakesEverything) {
  EXPECT_EQ(Take(0, {0, 1, 2, 50}), (std::vector<int>{0, 1, 2, 50}));
}

TEST(RateLimiter, TakesEverySecondOfTwiceTheRate) {
  EXPECT_EQ(Take(10, {0, 50, 100, 150, 200, 250}), (std::vector<int>{100, 200}));
}

TEST(RateLimiter, AcceptsAllButTheFirstAtItsRate) {
  EXPECT_EQ(Take(20, {0, 50, 100, 150, 200, 250}), (std::vector<int>{50, 100, 150, 200, 250}));
}

TEST(RateLimiter, KeepsTheMeanRateOfAnOddStream) {
  std::vector<int> stamps;  // 30 Hz for 10 s
  for (int i = 0; i < 300; ++i) stamps.push_back(i * 100 / 3);
  EXPECT_NEAR(static_cast<double>(Take(20, stamps).size()), 200, 3);
}

TEST(RateLimiter, RestartsAfterAGapAndABackwardJump) {
  EXPECT_EQ(Take(10, {0, 50, 100, 1150, 1200, 1250}), (std::vector<int>{100, 1250}));
  EXPECT_EQ(Take(10, {500, 550, 600, 0, 50, 100}), (std::vector<int>{600, 100}));
}

// The rule of the trackers of VINS-Mono and PL-VINS: a count that starts with one, and its rate
// since the first image.
std::vector<int> TakeAsTheOthersDo(double rate, const std::vector<int>& stamps) {
  std::vector<int> taken;
  int first = stamps[0], count = 1;
  for (size_t i = 1; i < stamps.size(); ++i) {
    const double so_far = 1e3 * count / (stamps[i] - first);
    if (std::lround(so_far) > rate) continue;
    if (std::abs(so_far - rate) < 0.01 * rate) {
      first = stamps[i];
      count = 0;
    }
    ++count;
    taken.push_back(stamps[i]);
  }
  return taken;
}

TEST(RateLimiter, AcceptsTheImagesThatVinsMonoAccepts) {
  for (const double rate : {5, 7, 10, 15, 19}) {
    for (const int period : {50, 33, 41}) {
      std::vector<int> stamps;
      for (int i = 0; i < 200; ++i) stamps.push_back(17 + period * i + i * i % 3);
      EXPECT_EQ(Take(rate, stamps), TakeAsTheOthersDo(rate, stamps)) << rate << " of " << period;
    }
  }
}

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

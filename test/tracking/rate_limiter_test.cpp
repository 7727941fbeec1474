// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/rate_limiter.h"

#include <gtest/gtest.h>

#include <vector>

namespace plm_vins {
namespace {

constexpr int64_t kMillisecond = 1'000'000;

// Which of the stamps [ms] are taken at `rate` [Hz].
std::vector<int> Take(double rate, const std::vector<int>& stamps) {
  RateLimiter limiter(rate);
  std::vector<int> taken;
  for (const int t : stamps) {
    if (limiter.Take(t * kMillisecond)) taken.push_back(t);
  }
  return taken;
}

TEST(RateLimiter, ZeroTakesEverything) {
  EXPECT_EQ(Take(0, {0, 1, 2, 50}), (std::vector<int>{0, 1, 2, 50}));
}

TEST(RateLimiter, TakesEverySecondOfTwiceTheRate) {
  EXPECT_EQ(Take(10, {0, 50, 100, 150, 200, 250}), (std::vector<int>{0, 100, 200}));
}

TEST(RateLimiter, TakesAllOfAStreamAtItsRateDespiteJitter) {
  const std::vector<int> stamps = {0, 52, 99, 148, 203, 250, 297};
  EXPECT_EQ(Take(20, stamps), stamps);
}

TEST(RateLimiter, KeepsTheMeanRateOfAnOddStream) {
  std::vector<int> stamps;  // 30 Hz for 10 s
  for (int i = 0; i < 300; ++i) stamps.push_back(i * 100 / 3);
  EXPECT_NEAR(static_cast<double>(Take(20, stamps).size()), 200, 3);
}

TEST(RateLimiter, DoesNotCatchUpAfterAGap) {
  EXPECT_EQ(Take(10, {0, 1000, 1020, 1040, 1100}), (std::vector<int>{0, 1000, 1100}));
}

// A tracker that is started again, or later than the other, must not choose the images in between.
TEST(RateLimiter, TwoThatBeginAtDifferentItemsComeToChooseTheSame) {
  for (int phase = 0; phase < 100; phase += 7) {
    std::vector<int> stamps;
    for (int i = 0; i < 20; ++i) stamps.push_back(1'000'000 + phase + 50 * i + i % 2);
    const std::vector<int> all = Take(10, stamps);
    for (int start = 1; start < 4; ++start) {
      const std::vector<int> later = Take(10, {stamps.begin() + start, stamps.end()});
      EXPECT_TRUE(std::equal(all.rbegin(), all.rbegin() + 7, later.rbegin())) << phase;
    }
  }
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "common/finding.h"

#include <gtest/gtest.h>

#include "common/recent_time.h"

namespace plm_vins {
namespace {

constexpr int64_t kSecond = 1'000'000'000;
constexpr int64_t kMidnight = 1'700'006'400 * kSecond;

TEST(FindingMemory, SaysUntilWhenAFindingLasted) {
  FindingMemory memory;
  EXPECT_FALSE(memory.Set(kMidnight, ""));
  EXPECT_EQ(memory.finding().text, "");
  EXPECT_TRUE(memory.Set(kMidnight, "a fault"));
  EXPECT_FALSE(memory.Set(kMidnight, "a fault"));
  EXPECT_TRUE(memory.finding().is_present);
  EXPECT_EQ(memory.finding().text, "a fault");
  for (const int64_t later : {0, 5}) {
    EXPECT_FALSE(memory.Set(kMidnight + (12 * 3600 + 3 * 60 + 10 + later) * kSecond, ""));
    EXPECT_FALSE(memory.finding().is_present);
    EXPECT_EQ(memory.finding().text, "a fault (until 12:03:10 UTC)");
  }
  EXPECT_TRUE(memory.Set(kMidnight, "another"));
  EXPECT_EQ(memory.finding().text, "another");
}

TEST(FindingMemory, WhatHasPassedCountsLess) {
  FindingMemory memory;
  memory.Set(kMidnight, "a fault", 10);
  EXPECT_EQ(memory.finding().sigmas, 10);
  for (int i = 0; i < 2; ++i) memory.Set(kMidnight + i * kSecond, "");
  EXPECT_EQ(memory.finding().sigmas, 3);
}

TEST(RecentTime, DecaysHalfAsFastAsItGrows) {
  RecentTime time;
  for (int i = 0; i < 19; ++i) time.Add(0.1, true);
  EXPECT_FALSE(time.IsLong());
  for (int i = 0; i < 80; ++i) time.Add(0.1, true);
  EXPECT_TRUE(time.IsLong());
  time.Add(7.9, false);
  EXPECT_TRUE(time.IsLong());
  time.Add(0.2, false);
  EXPECT_FALSE(time.IsLong());
}

}  // namespace
}  // namespace plm_vins

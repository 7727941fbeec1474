// SPDX-License-Identifier: BSD-3-Clause
#include "common/streams/stream_rhythm.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

constexpr int64_t kMs = 1'000'000;

TEST(StreamRhythm, ReportsNothingBeforeEnoughStamps) {
  StreamRhythm rhythm;
  for (int64_t i = 0; i < 100; ++i) rhythm.Add(50 * i * kMs);
  EXPECT_EQ(rhythm.Interval(), 0);
  EXPECT_EQ(rhythm.Jitter(), 0);
}

TEST(StreamRhythm, MissingStampIsNotJitter) {
  StreamRhythm rhythm;
  for (int64_t i = 0; i < 150; ++i) {
    if (i % 10 != 3) rhythm.Add(50 * i * kMs);
  }
  EXPECT_DOUBLE_EQ(rhythm.Interval(), 0.05);
  EXPECT_NEAR(rhythm.Jitter(), 0, 1e-12);
}

TEST(StreamRhythm, MeasuresJitter) {
  StreamRhythm rhythm;
  const int64_t shifts[] = {0, 3, 0, -3};
  for (int64_t i = 0; i < 201; ++i) rhythm.Add((50 * i + shifts[i % 4]) * kMs);
  EXPECT_NEAR(rhythm.Jitter(), 0.003, 0.003);
  EXPECT_GT(rhythm.Jitter(), 0.0025);
}

TEST(StreamRhythm, StartsOverWhereStampsGoBack) {
  StreamRhythm rhythm;
  for (int64_t i = 0; i < 101; ++i) rhythm.Add(50 * i * kMs);
  EXPECT_GT(rhythm.Interval(), 0);
  rhythm.Add(0);
  EXPECT_EQ(rhythm.Interval(), 0);
}

}  // namespace
}  // namespace plm_vins

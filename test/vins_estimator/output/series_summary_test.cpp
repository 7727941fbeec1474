// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/series_summary.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(SeriesSummary, IsOfOneEntryOfTheFrames) {
  std::vector<std::array<double, 3>> frames(100);
  for (int i = 0; i < 100; ++i) {
    frames[i].fill(-1);
    frames[i][1] = (i * 37) % 100 + 1;  // 1 ... 100 in arbitrary order
  }
  const SeriesSummary summary = Summarize(frames, 1);
  EXPECT_DOUBLE_EQ(summary.mean, 50.5);
  EXPECT_DOUBLE_EQ(summary.median, 50);
  EXPECT_DOUBLE_EQ(summary.p95, 95);
  EXPECT_DOUBLE_EQ(summary.p99, 99);
}

TEST(SeriesSummary, OneFrameAndNone) {
  using Frames = std::vector<std::array<int, 2>>;
  EXPECT_DOUBLE_EQ(Summarize(Frames{{1, 8}}, 1).p95, 8);
  EXPECT_DOUBLE_EQ(Summarize(Frames{{1, 8}}, 1).median, 8);
  EXPECT_DOUBLE_EQ(Summarize(Frames(), 0).p95, 0);
  EXPECT_DOUBLE_EQ(Summarize(Frames(), 0).mean, 0);
}

}  // namespace
}  // namespace plm_vins

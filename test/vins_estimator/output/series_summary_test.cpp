// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/series_summary.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(SeriesSummary, HasMeanAndPercentiles) {
  std::vector<double> values(100);
  for (int i = 0; i < 100; ++i) values[i] = (i * 37) % 100 + 1;  // 1 ... 100 in arbitrary order
  const SeriesSummary summary = Summarize(values);
  EXPECT_DOUBLE_EQ(summary.mean, 50.5);
  EXPECT_DOUBLE_EQ(summary.median, 50);
  EXPECT_DOUBLE_EQ(summary.p95, 95);
  EXPECT_DOUBLE_EQ(summary.p99, 99);
}

TEST(SeriesSummary, OneValueAndNone) {
  EXPECT_DOUBLE_EQ(Summarize({8}).p95, 8);
  EXPECT_DOUBLE_EQ(Summarize({8}).median, 8);
  EXPECT_DOUBLE_EQ(Summarize({}).p95, 0);
  EXPECT_DOUBLE_EQ(Summarize({}).mean, 0);
}

}  // namespace
}  // namespace plm_vins

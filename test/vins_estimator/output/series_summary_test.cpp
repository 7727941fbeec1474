// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/series_summary.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

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

TEST(SeriesTest, IsExactWhileItIsShort) {
  Series series;
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) series.Add(values.emplace_back((i * 37) % 1000));
  EXPECT_DOUBLE_EQ(series.Summary().mean, Summarize(values).mean);
  EXPECT_DOUBLE_EQ(series.Summary().p99, Summarize(values).p99);
  EXPECT_DOUBLE_EQ(Series().Summary().mean, 0);
}

// 1 ... 100003, a prime, in arbitrary order.
TEST(SeriesTest, LongOnesHaveNearlyTheirPercentiles) {
  Series series;
  constexpr int64_t kValues = 100003;
  for (int64_t i = 0; i < kValues; ++i) series.Add(static_cast<double>(i * 40009 % kValues + 1));
  const SeriesSummary summary = series.Summary();
  EXPECT_DOUBLE_EQ(summary.mean, (kValues + 1) / 2.0);
  EXPECT_NEAR(summary.median, 0.5 * kValues, 0.01 * kValues);
  EXPECT_NEAR(summary.p99, 0.99 * kValues, 0.01 * kValues);
}

}  // namespace
}  // namespace plm_vins

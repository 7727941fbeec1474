// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/imu_history.h"

#include <gtest/gtest.h>

#include <utility>

namespace plm_vins {
namespace {

constexpr int64_t kStep_ns = 5'000'000;

ImuSample SampleAt(int64_t t_ns) {
  const double t = 1e-9 * static_cast<double>(t_ns);
  ImuSample sample;
  sample.t_ns = t_ns;
  sample.gyro = {0.1 * t, 0.2, -0.1};
  sample.accel = {t, 0.5, 9.8};
  return sample;
}

ImuHistory SecondOfSamples() {
  ImuHistory history;
  for (int i = 0; i <= 200; ++i) history.Add(SampleAt(i * kStep_ns));
  return history;
}

TEST(ImuHistoryTest, IntegratesBetweenStamps) {
  const ImuHistory history = SecondOfSamples();

  const auto between = history.Between(0, 102'500'000, 900'000'000, ImuNoise{}, ImuBias{});

  ASSERT_TRUE(between);
  Preintegration expected(ImuNoise{}, ImuBias{});
  expected.Append(SampleAt(102'500'000));  // readings are linear in time
  for (int i = 21; i <= 180; ++i) expected.Append(SampleAt(i * kStep_ns));
  EXPECT_EQ(between->samples().size(), expected.samples().size());
  EXPECT_NEAR(between->duration(), 0.7975, 1e-12);
  EXPECT_LT((between->delta_p() - expected.delta_p()).norm(), 1e-12);
  EXPECT_LT((between->delta_v() - expected.delta_v()).norm(), 1e-12);
}

// The remaining samples serve the intervals before and after, up to both times.
TEST(ImuHistoryTest, ForgetsWhatIsNotNeeded) {
  const ImuHistory complete = SecondOfSamples();
  ImuHistory history = SecondOfSamples();
  history.Forget(0, 302'000'000, 702'000'000);
  history.Forget(0, 302'000'000, 702'000'000);
  for (const auto& [from_ns, to_ns] :
       {std::pair<int64_t, int64_t>{1'000'000, 302'000'000}, {702'000'000, 999'000'000}}) {
    const auto between = history.Between(0, from_ns, to_ns, ImuNoise{}, ImuBias{});
    const auto expected = complete.Between(0, from_ns, to_ns, ImuNoise{}, ImuBias{});
    ASSERT_TRUE(between && expected);
    EXPECT_EQ(between->delta_p(), expected->delta_p());
    EXPECT_EQ(between->samples().size(), expected->samples().size());
  }
  const auto across = history.Between(0, 0, 1'000'000'000, ImuNoise{}, ImuBias{});
  EXPECT_LT(across->samples().size(), 130u);  // of 201
}

TEST(ImuHistoryTest, ReturnsNulloptBeyondItsSamples) {
  const ImuHistory history = SecondOfSamples();
  EXPECT_FALSE(history.Between(0, -1, 500'000'000, ImuNoise{}, ImuBias{}));
  EXPECT_FALSE(history.Between(0, 500'000'000, 1'000'000'001, ImuNoise{}, ImuBias{}));
  EXPECT_FALSE(history.Between(0, 500'000'000, 500'000'000, ImuNoise{}, ImuBias{}));
  EXPECT_FALSE(ImuHistory().Between(-1, 0, 1, ImuNoise{}, ImuBias{}));
}

TEST(ImuHistoryTest, AcceptsAStampOnce) {
  ImuHistory history = SecondOfSamples();
  history.Add(SampleAt(200 * kStep_ns));
  EXPECT_TRUE(history.Between(0, 0, 1'000'000'000, ImuNoise{}, ImuBias{}));
}

TEST(ImuHistoryTest, KeepsRecordingsApartWhereStampsJumpBack) {
  ImuHistory history = SecondOfSamples();
  EXPECT_EQ(history.newest(), 0);
  for (int i = 20; i <= 60; ++i) {
    ImuSample sample = SampleAt(i * kStep_ns);
    sample.accel *= 2;
    history.Add(sample);
  }
  EXPECT_EQ(history.newest(), 1);
  const auto first = history.Between(0, 100'000'000, 300'000'000, ImuNoise{}, ImuBias{});
  const auto second = history.Between(1, 100'000'000, 300'000'000, ImuNoise{}, ImuBias{});
  ASSERT_TRUE(first && second);
  EXPECT_LT((second->delta_v() - 2 * first->delta_v()).norm(), 1e-12);
  EXPECT_FALSE(history.Between(1, 0, 200'000'000, ImuNoise{}, ImuBias{}));
  EXPECT_FALSE(history.Between(2, 100'000'000, 300'000'000, ImuNoise{}, ImuBias{}));
}

}  // namespace
}  // namespace plm_vins

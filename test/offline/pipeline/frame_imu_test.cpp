// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/frame_imu.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace plm_vins {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int64_t kMillisecond = 1'000'000;

ImuSample Sample(int64_t milliseconds, double gyro_x = 0.1) {
  return {milliseconds * kMillisecond, {gyro_x, 0, 0}, {0, 0, 9.81}};
}

FrameImu WithSamples(const std::vector<int64_t>& milliseconds) {
  FrameImu imu{ImuRange()};
  for (const int64_t t : milliseconds) imu.Add(Sample(t));
  return imu;
}

std::vector<int64_t> Take(int64_t milliseconds, FrameImu* imu) {
  std::vector<int64_t> taken;
  for (const ImuSample& sample : imu->Take(milliseconds * kMillisecond)) {
    taken.push_back(sample.t_ns / kMillisecond);
  }
  return taken;
}

TEST(FrameImu, GivesEverySampleOnce) {
  FrameImu imu = WithSamples({5, 10, 15, 20, 25});
  EXPECT_THAT(Take(15, &imu), ElementsAre(5, 10, 15));
  EXPECT_THAT(Take(15, &imu), IsEmpty());
  EXPECT_THAT(Take(24, &imu), ElementsAre(20));
  imu.Add(Sample(30));
  EXPECT_THAT(Take(100, &imu), ElementsAre(25, 30));
}

TEST(FrameImu, LeavesOutWhatIsNotInOrderOfTime) {
  FrameImu imu = WithSamples({5, 10, 10, 7, 15});
  EXPECT_THAT(Take(100, &imu), ElementsAre(5, 10, 15));
}

TEST(FrameImu, AWrongStampInTheFutureDoesNotHoldUpThoseThatFollow) {
  FrameImu imu = WithSamples({5, 10, 3'600'000, 15, 20});
  EXPECT_THAT(Take(100, &imu), ElementsAre(5, 10, 15, 20));
}

TEST(FrameImu, GivesThoseAfterAGap) {
  FrameImu imu = WithSamples({5, 10, 1000, 1005});
  EXPECT_THAT(Take(2000, &imu), ElementsAre(5, 10, 1000, 1005));
}

TEST(FrameImu, LeavesOutWhatIsNoReadingAndReplacesOutliers) {
  FrameImu imu = WithSamples({5, 10, 15, 20});
  imu.Add(Sample(25, std::numeric_limits<double>::quiet_NaN()));
  imu.Add(Sample(30, 90));
  imu.Add(Sample(35));
  const std::vector<ImuSample> taken = imu.Take(100 * kMillisecond);
  ASSERT_EQ(taken.size(), 6u);
  EXPECT_NEAR(taken[4].gyro.x(), 0.1, 1e-9);
  EXPECT_GT(taken[4].gyro_doubt, 1);
}

TEST(FrameImu, BeginsAnewWhereItIsCleared) {
  FrameImu imu = WithSamples({1005, 1010});
  imu.Clear();
  for (const int64_t t : {5, 10, 15}) imu.Add(Sample(t));
  EXPECT_THAT(Take(2000, &imu), ElementsAre(5, 10, 15));
}

}  // namespace
}  // namespace plm_vins

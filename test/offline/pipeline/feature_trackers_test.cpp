// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/feature_trackers.h"

#include <gtest/gtest.h>

#include "test/testing/still_scene.h"

namespace plm_vins {
namespace {

using testing::StillConfig;
using testing::StillImu;
using testing::StillPicture;

constexpr int64_t kMillisecond = 1'000'000;

// A run with irregular input: a repeated image, one of another size, a gap of the gyroscope, a gap
// between images, and timestamps that start again.
std::vector<TrackedFeatures> AwkwardRun(FeatureTrackers* trackers) {
  std::vector<TrackedFeatures> frames;
  const auto add = [&](int t, const cv::Mat& picture) {
    const bool gyro = t < 1000 || t > 1500;
    for (int imu = t - 45; gyro && imu <= t; imu += 5)
      trackers->AddImu(StillImu((10'000 + imu) * kMillisecond));
    trackers->AddImage(0, {(10'000 + t) * kMillisecond, picture});
    while (auto frame = trackers->Pop()) frames.push_back(std::move(*frame));
  };
  for (int t = 0; t < 2000; t += 50) add(t, StillPicture());
  add(1950, StillPicture());
  add(2000, StillPicture({160, 120}));
  for (int t = 4025; t < 6000; t += 33) add(t, StillPicture());
  for (int t = -5000; t < -3000; t += 50) add(t, StillPicture());
  while (auto frame = trackers->Flush()) frames.push_back(std::move(*frame));
  return frames;
}

TEST(FeatureTrackers, PointsAndLinesAgreeOnEveryImage) {
  for (const double rate : {0, 10, 15}) {
    Config config = StillConfig();
    config.publish_rate = rate;
    FeatureTrackers trackers(config);
    const auto frames = AwkwardRun(&trackers);
    EXPECT_GT(frames.size(), 120u);
    int restarts = 0;
    int published = 0;
    for (const TrackedFeatures& frame : frames) {
      ASSERT_TRUE(frame.lines);
      EXPECT_EQ(frame.lines->features.t_ns, frame.points.features.t_ns);
      EXPECT_EQ(frame.lines->restart, frame.points.restart);
      EXPECT_EQ(frame.lines->publish, frame.points.publish);
      restarts += frame.points.restart ? 1 : 0;
      published += frame.points.publish ? 1 : 0;
    }
    EXPECT_EQ(restarts, 1);
    EXPECT_EQ(published == static_cast<int>(frames.size()), rate == 0);
  }
}

TEST(FeatureTrackers, LinesCanBeSwitchedOff) {
  Config config = StillConfig();
  config.use_lines = false;
  FeatureTrackers trackers(config);
  for (const TrackedFeatures& frame : AwkwardRun(&trackers)) EXPECT_FALSE(frame.lines);
  EXPECT_TRUE(trackers.DrawLines().empty());
  EXPECT_FALSE(trackers.DrawPoints().empty());
}

}  // namespace
}  // namespace plm_vins

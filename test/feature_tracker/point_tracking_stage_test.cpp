// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/point_tracking_stage.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "test/testing/still_scene.h"

namespace plm_vins {
namespace {

using testing::StillConfig;
using testing::StillImu;
using testing::StillPicture;

constexpr int64_t kMillisecond = 1'000'000;
constexpr int64_t kStart = 1403636579763555584;

class PointTrackingStageTest : public ::testing::Test {
 protected:
  void AddImage(int milliseconds) { AddImage(milliseconds, picture_); }
  void AddImage(int milliseconds, const cv::Mat& picture) {
    stage_.AddImage({kStart + milliseconds * kMillisecond, picture});
  }

  // IMU samples every 5 ms.
  void AddImu(int from, int to) {
    for (int t = from; t <= to; t += 5) stage_.AddImu(StillImu(kStart + t * kMillisecond));
  }

  // Stamps of what is ready [ms].
  std::vector<int> Pop() {
    return Take([this] { return stage_.Pop(); });
  }
  std::vector<int> Flush() {
    return Take([this] { return stage_.Flush(); });
  }

  template <typename Next>
  std::vector<int> Take(const Next& next) {
    std::vector<int> stamps;
    while (const auto frame = next()) {
      stamps.push_back(static_cast<int>((frame->points.t_ns - kStart) / kMillisecond));
      last_ = *frame;
    }
    return stamps;
  }

  const cv::Mat picture_ = StillPicture();
  PointTrackingStage stage_{StillConfig()};
  TrackedFrame last_;
};

TEST_F(PointTrackingStageTest, AnImageWaitsForTheGyro) {
  AddImu(-10, 40);
  AddImage(0);
  EXPECT_EQ(Pop(), (std::vector<int>{0}));
  AddImage(50);
  EXPECT_TRUE(Pop().empty());
  AddImu(45, 50);
  EXPECT_EQ(Pop(), (std::vector<int>{50}));
  EXPECT_GT(last_.points.points.size(), 20u);
  EXPECT_GT(last_.tracking_ms, 0);
  EXPECT_EQ(stage_.counts().without_gyro, 0);
}

TEST_F(PointTrackingStageTest, AnImageWaitsForTwoNewerOnesAtMost) {
  AddImage(0);
  AddImage(50);
  EXPECT_TRUE(Pop().empty());
  AddImage(100);
  EXPECT_EQ(Pop(), (std::vector<int>{0}));
  EXPECT_TRUE(stage_.waiting());
  EXPECT_EQ(Flush(), (std::vector<int>{50, 100}));
  EXPECT_FALSE(stage_.waiting());
  EXPECT_EQ(stage_.counts().without_gyro, 2);
}

TEST_F(PointTrackingStageTest, KeepsTheIdsOfAStillScene) {
  AddImage(0);
  Flush();
  const PointFrame first = last_.points;
  AddImage(50);
  Flush();
  ASSERT_EQ(last_.points.points.size(), first.points.size());
  for (size_t i = 0; i < first.points.size(); ++i) {
    EXPECT_EQ(last_.points.points[i].id, first.points[i].id);
  }
}

TEST_F(PointTrackingStageTest, DropsStampsThatRepeatOrGoBack) {
  for (const int t : {0, 50, 50, 20, 100}) AddImage(t);
  EXPECT_EQ(Flush(), (std::vector<int>{0, 50, 100}));
  EXPECT_EQ(stage_.counts().images, 5);
  EXPECT_EQ(stage_.counts().out_of_order, 2);
  EXPECT_EQ(stage_.counts().restarts, 0);
}

TEST_F(PointTrackingStageTest, CountsImagesThatShowHardlyAnything) {
  AddImage(0);
  for (const int t : {50, 100}) AddImage(t, cv::Mat::zeros(picture_.size(), CV_8UC1));
  EXPECT_EQ(Flush(), (std::vector<int>{0, 50, 100}));
  EXPECT_EQ(stage_.counts().few_points, 2);
}

TEST_F(PointTrackingStageTest, BeginsAnewWhenTheRecordingDoes) {
  for (int t = 5000; t < 5500; t += 50) AddImage(t);
  EXPECT_EQ(Flush().size(), 10u);
  EXPECT_FALSE(last_.restart);
  for (int t = 0; t < 550; t += 50) AddImage(t);  // ten are refused, the next begins anew
  EXPECT_EQ(Flush(), (std::vector<int>{500}));
  EXPECT_TRUE(last_.restart);
  EXPECT_EQ(stage_.counts().restarts, 1);
  AddImu(500, 600);  // the gyro's history begins anew, too
  AddImage(550);
  EXPECT_EQ(Pop(), (std::vector<int>{550}));
  EXPECT_FALSE(last_.restart);
}

TEST_F(PointTrackingStageTest, DropsImagesOfAnotherSizeAndSaysWhichSize) {
  AddImage(0);
  AddImage(50, StillPicture({160, 120}));
  AddImage(100, cv::Mat(240, 320, CV_8UC3));
  AddImage(150, cv::Mat());
  AddImage(200);
  EXPECT_EQ(Flush(), (std::vector<int>{0, 200}));
  EXPECT_EQ(stage_.counts().wrong_format, 3);
  EXPECT_NE(stage_.counts().wrong_format_detail.find("160"), std::string::npos)
      << stage_.counts().wrong_format_detail;
}

TEST_F(PointTrackingStageTest, CountsGapsButLosesNothingByThem) {
  for (const int t : {0, 50, 1200, 1250}) AddImage(t);
  EXPECT_EQ(Flush().size(), 4u);
  EXPECT_EQ(stage_.counts().gaps, 1);
}

TEST(PointTrackingStage, ThinsToThePublishRateButTracksAll) {
  Config config = StillConfig();
  config.points.publish_rate = 10;
  PointTrackingStage stage(config);
  std::vector<bool> published;
  for (int i = 0; i < 5; ++i) {
    stage.AddImage({kStart + i * 50 * kMillisecond, StillPicture()});
    published.push_back(stage.Flush()->publish);
  }
  EXPECT_EQ(published, (std::vector<bool>{true, false, true, false, true}));
}

// The gyro says nothing about the images while the camera's rotation is unknown.
TEST(PointTrackingStage, DoesWithoutTheGyroWhereTheCameraRotationIsUnknown) {
  Config config = StillConfig();
  config.sensor.estimate_extrinsic = SensorConfig::ExtrinsicMode::kCalibrateRotation;
  PointTrackingStage stage(config);
  PointFrame first;
  for (const int t : {0, 50}) {
    for (int imu = t - 50; imu <= t; imu += 5) {  // turns fast; the picture does not
      ImuSample sample = StillImu(kStart + imu * kMillisecond);
      sample.gyro = Eigen::Vector3d(0, 0, 5);
      stage.AddImu(sample);
    }
    stage.AddImage({kStart + t * kMillisecond, StillPicture()});
    const auto frame = stage.Pop();
    ASSERT_TRUE(frame);
    if (t == 0) first = frame->points;
    EXPECT_EQ(frame->points.points.size(), first.points.size());
  }
  stage.AddImage({kStart + 100 * kMillisecond, StillPicture()});
  EXPECT_TRUE(stage.Pop()) << "waits for the gyro";
  EXPECT_EQ(stage.counts().without_gyro, 0);
}

}  // namespace
}  // namespace plm_vins

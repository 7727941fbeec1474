// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/point_tracking_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <set>
#include <string>

#include "test/testing/still_scene.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using testing::StillConfig;
using testing::StillPicture;

constexpr int64_t kMillisecond = 1'000'000;

std::set<int64_t> Ids(const PointFrame& frame) {
  std::set<int64_t> ids;
  for (const PointObservation& point : frame.points) ids.insert(point.id);
  return ids;
}

class PointTrackingStageTest : public ::testing::Test {
 protected:
  TrackedPoints Track(int milliseconds, const cv::Mat& picture = StillPicture()) {
    stage_.AddImage(0, {milliseconds * kMillisecond, picture});
    EXPECT_TRUE(stage_.waiting());
    auto frame = stage_.Flush();
    EXPECT_FALSE(stage_.waiting());
    return frame.value();
  }

  PointTrackingStage stage_{StillConfig()};
};

TEST_F(PointTrackingStageTest, KeepsTheIdsOfAStillScene) {
  const TrackedPoints first = Track(1000);
  EXPECT_EQ(first.features.t_ns, 1000 * kMillisecond);
  EXPECT_GT(first.features.points.size(), 20u);
  EXPECT_GT(first.tracking_ms, 0);
  const TrackedPoints second = Track(1050);
  EXPECT_EQ(Ids(second.features), Ids(first.features));
  EXPECT_EQ(second.statistics.previous, static_cast<int>(first.features.points.size()));
}

TEST_F(PointTrackingStageTest, DropsItsTracksAtANewRecording) {
  const TrackedPoints before = Track(5000);
  for (int t = 0; t < 500; t += 50) stage_.AddImage(0, {t * kMillisecond, StillPicture()});
  const TrackedPoints after = Track(500);
  EXPECT_TRUE(after.restart);
  EXPECT_GT(*Ids(after.features).begin(), *Ids(before.features).rbegin());
}

TEST_F(PointTrackingStageTest, WaitsForTheGyro) {
  stage_.AddImage(0, {0, StillPicture()});
  EXPECT_FALSE(stage_.Pop());
  stage_.AddImu(testing::StillImu(0));
  EXPECT_TRUE(stage_.Pop());
}

TEST(PointTrackingStage, ErrorOfAnInvalidMaskNamesTheConfiguration) {
  const testing::TemporaryFolder folder;
  Config config = StillConfig();
  config.file = "camera.yaml";
  config.points.fisheye_mask = folder.File("mask.png");
  const auto error = [&] {
    try {
      PointTrackingStage stage(config);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string key = "camera.yaml: fisheye_mask: ";
  folder.Write("mask.png", "echo no picture");
  EXPECT_EQ(error(), key + "cannot read the image " + config.points.fisheye_mask);
  cv::imwrite(config.points.fisheye_mask, cv::Mat(10, 20, CV_8UC1, cv::Scalar(255)));
  EXPECT_THAT(error(),
              ::testing::StartsWith(key + config.points.fisheye_mask +
                                    " has 20x10 pixels, but image_width and image_height"));
}

}  // namespace
}  // namespace plm_vins

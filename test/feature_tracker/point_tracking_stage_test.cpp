// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/point_tracking_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <string>
#include <vector>

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

// A camera that looks ahead, and one that looks back.
Config FrontAndBack() {
  Config config = StillConfig();
  CameraSensor back = config.sensor.cameras[0];
  back.T_B_C.rotation = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY());
  config.sensor.cameras.push_back(back);
  return config;
}

int CountOf(int camera, const PointFrame& frame) {
  return static_cast<int>(
      std::count_if(frame.points.begin(), frame.points.end(),
                    [camera](const PointObservation& point) { return point.camera == camera; }));
}

TEST(PointTrackingStage, TracksCamerasWithoutOverlapOnTheirOwn) {
  PointTrackingStage stage(FrontAndBack());
  EXPECT_EQ(stage.tracked_cameras(), (std::vector<int>{0, 1}));
  PointFrame first;
  for (int i = 0; i < 2; ++i) {
    const int64_t t_ns = i * 50 * kMillisecond;
    stage.AddImage(1, {t_ns + kMillisecond, StillPicture()});
    stage.AddImage(0, {t_ns, StillPicture()});
    const PointFrame frame = stage.Flush().value().features;
    EXPECT_EQ(frame.t_ns, t_ns);
    EXPECT_GT(CountOf(0, frame), 20);
    EXPECT_EQ(CountOf(1, frame), CountOf(0, frame));
    EXPECT_EQ(Ids(frame).size(), frame.points.size());  // no id in two cameras
    EXPECT_TRUE(std::is_sorted(frame.points.begin(), frame.points.end(),
                               [](const auto& a, const auto& b) { return a.camera < b.camera; }));
    if (i == 0) first = frame;
    EXPECT_EQ(Ids(frame), Ids(first));
  }
}

TEST(PointTrackingStage, ACameraThatPausesKeepsItsTracks) {
  PointTrackingStage stage(FrontAndBack());
  std::vector<std::set<int64_t>> ids;
  for (int i = 0; i < 5; ++i) {
    const int64_t t_ns = i * 50 * kMillisecond;
    const bool pauses = i == 2 || i == 3;
    if (!pauses) stage.AddImage(1, {t_ns, StillPicture()});
    stage.AddImage(0, {t_ns, StillPicture()});
    const PointFrame frame = stage.Flush().value().features;
    EXPECT_GT(CountOf(0, frame), 20);
    EXPECT_EQ(CountOf(1, frame) == 0, pauses);
    ids.push_back(Ids(frame));
  }
  EXPECT_EQ(ids[4], ids[0]);
  EXPECT_EQ(stage.counts().others[0].missing.count().count, 2);
}

TEST(PointTrackingStage, TheSecondCameraOfAPairHasNoTracker) {
  Config config = FrontAndBack();
  config.sensor.cameras.push_back(config.sensor.cameras[0]);
  config.sensor.cameras[2].T_B_C.translation.x() = 0.1;
  const PointTrackingStage stage(config);
  EXPECT_EQ(stage.tracked_cameras(), (std::vector<int>{0, 1}));
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

// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/line_tracking_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "linefeature_tracker/detection/line_detector.h"
#include "test/linefeature_tracker/bar_scene.h"
#include "test/testing/message_of.h"

namespace plm_vins {
namespace {

constexpr int64_t kMillisecond = 1'000'000;

std::set<int64_t> Ids(const LineFrame& frame) {
  std::set<int64_t> ids;
  for (const LineObservation& line : frame.lines) ids.insert(line.id);
  return ids;
}

class LineTrackingStageTest : public ::testing::Test {
 protected:
  LineTrackingStageTest() {
    Config config;
    config.sensor.cameras[0].parameters = PlainParameters();
    config.lines.max_lines = 60;
    config.lines.half_resolution = false;
    config.lines.min_length = 0.05;
    stage_ = std::make_unique<LineTrackingStage>(config);
  }

  TrackedLines Track(int milliseconds, const cv::Mat& picture) {
    stage_->AddImage(0, {milliseconds * kMillisecond, picture});
    return stage_->Flush().value();
  }

  const cv::Mat bars_ = BarScene(PlainParameters()).View();
  std::unique_ptr<LineTrackingStage> stage_;
};

TEST_F(LineTrackingStageTest, KeepsTheIdsOfAStillScene) {
  const TrackedLines first = Track(1000, bars_);
  EXPECT_EQ(first.features.t_ns, 1000 * kMillisecond);
  EXPECT_GT(first.features.lines.size(), 30u);
  EXPECT_EQ(first.statistics.added, static_cast<int>(first.features.lines.size()));
  EXPECT_GT(first.statistics.detection_ms, 0);
  EXPECT_GT(first.tracking_ms, first.statistics.detection_ms);
  const TrackedLines second = Track(1050, bars_);
  EXPECT_EQ(Ids(second.features), Ids(first.features));
  EXPECT_EQ(second.statistics.previous, first.statistics.added);
}

TEST_F(LineTrackingStageTest, DropsItsTracksAtANewRecording) {
  const TrackedLines before = Track(5000, bars_);
  for (int t = 0; t < 500; t += 50) stage_->AddImage(0, {t * kMillisecond, bars_});
  const TrackedLines after = Track(500, bars_);
  EXPECT_TRUE(after.restart);
  EXPECT_GT(*Ids(after.features).begin(), *Ids(before.features).rbegin());
}

TEST_F(LineTrackingStageTest, AnImageWithoutLinesGivesAnEmptyFrame) {
  const cv::Mat blank(bars_.size(), CV_8UC1, cv::Scalar(100));
  EXPECT_FALSE(Track(0, bars_).features.lines.empty());
  const TrackedLines lost = Track(50, blank);
  EXPECT_TRUE(lost.features.lines.empty());
  EXPECT_EQ(lost.features.t_ns, 50 * kMillisecond);
  for (const int t : {100, 150, 200}) stage_->AddImage(0, {t * kMillisecond, bars_});
  TrackedLines found;
  while (auto frame = stage_->Flush()) found = *frame;
  EXPECT_FALSE(found.features.lines.empty());
}

TEST(LineTrackingStage, ErrorOfAMissingDetectorNamesTheConfiguration) {
  if (LineDetector::IsAvailable(LineDetectorType::kLsd)) GTEST_SKIP() << "it has all detectors";
  Config config;
  config.file = "camera.yaml";
  config.sensor.cameras[0].parameters = PlainParameters();
  config.lines.line_detector = LineDetectorType::kLsd;
  EXPECT_THAT(testing::MessageOf([&] { LineTrackingStage stage(config); }),
              ::testing::StartsWith("camera.yaml: line_detector: OpenCV "));
}

TEST(LineTrackingStage, TakesTheMaskOfThePoints) {
  Config config;
  config.file = "camera.yaml";
  config.sensor.cameras[0].parameters = PlainParameters();
  config.points.fisheye_mask = "no_such_file.png";
  EXPECT_EQ(testing::MessageOf([&] { LineTrackingStage stage(config); }),
            "camera.yaml: fisheye_mask: cannot read the image no_such_file.png");
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/tracker_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "test/testing/still_scene.h"

namespace plm_vins {
namespace {

using ::testing::StartsWith;

using testing::StillConfig;

TEST(TrackerValues, AreKeysOfTheTrackers) {
  Config config = StillConfig();
  config.publish_rate = 12.5;
  const Json values = TrackerValues(config);
  EXPECT_EQ(values.at("max_cnt"), config.points.max_cnt);
  EXPECT_EQ(values.at("freq"), 12.5);
  EXPECT_EQ(values.at("projection_parameters.fx"), 200);
  EXPECT_TRUE(values.contains("line_min_length"));
  for (const std::string name : {"window_size", "td", "rolling_shutter", "acc_n", "show_track"}) {
    EXPECT_FALSE(values.contains(name)) << name;
  }
  config.use_lines = false;
  EXPECT_FALSE(TrackerValues(config).contains("line_min_length"));
}

TEST(TrackerValues, HaveTheFurtherCamerasAndDepth) {
  Config config = StillConfig();
  config.sensor.cameras.push_back(config.sensor.cameras[0]);
  const Json recorded = TrackerValues(config);
  EXPECT_EQ(recorded.at("cam1_projection_parameters.fx"), 200);
  EXPECT_EQ(RecordedOtherwise(recorded, StillConfig()).at("num_of_cam"), 2);
  config.sensor.depth.emplace().topic = "/depth";
  EXPECT_TRUE(RecordedOtherwise(recorded, config).contains("depth_topic"));
}

TEST(RecordedOtherwise, IsEmptyIfOnlyEstimatorKeysDiffer) {
  Config config = StillConfig();
  const Json recorded = Json::parse(TrackerValues(config).dump());
  config.estimator.window_size = 7;
  config.sensor.td = 0.01;
  config.sensor.rolling_shutter = true;
  EXPECT_EQ(RecordedOtherwise(recorded, config), Json::object());
  config.points.fisheye_mask = "a path that is no UTF-8: \xff.png";
  EXPECT_EQ(RecordedOtherwise(TrackerValues(config), config), Json::object());
}

TEST(RecordedOtherwise, HasRecordedValuesAndAWarning) {
  Config config = StillConfig();
  config.use_lines = false;
  const Json recorded = TrackerValues(config);
  config.use_lines = true;
  config.points.max_cnt = 30;
  config.publish_rate = 5;
  config.sensor.cameras[0].parameters.cx = 150;
  const Json otherwise = RecordedOtherwise(recorded, config);
  EXPECT_EQ(otherwise.size(), 4u);
  EXPECT_EQ(otherwise.at("max_cnt"), 60);
  EXPECT_EQ(otherwise.at("freq"), 0);
  EXPECT_EQ(otherwise.at("use_lines"), false);
  EXPECT_EQ(otherwise.at("projection_parameters.cx"), 160);
  const std::string warning = RecordedOtherwiseWarning("x.features", otherwise);
  EXPECT_THAT(warning, StartsWith("x.features was recorded with other values of "));
  for (const auto& [name, value] : otherwise.items()) {
    EXPECT_NE(warning.find(name), std::string::npos) << name;
  }
}

// Recorded lines may be ignored, and then their configuration does not matter.
TEST(RecordedOtherwise, IsEmptyIfLinesAreIgnored) {
  Config config = StillConfig();
  const Json recorded = TrackerValues(config);
  config.use_lines = false;
  config.lines.min_length *= 2;
  EXPECT_EQ(RecordedOtherwise(recorded, config), Json::object());
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/loop_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <optional>
#include <sstream>
#include <string>

#include "pose_graph/output/map_file.h"
#include "test/testing/message_of.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class LoopResultsTest : public ::testing::Test {
 protected:
  LoopResultsTest() {
    CameraParameters& camera = config_.sensor.cameras[0].parameters;
    camera.width = 320;
    camera.height = 240;
    camera.fx = camera.fy = 200;
    camera.cx = 160;
    camera.cy = 120;
  }

  // An image of random gray levels at x [m], half a second after the previous one.
  PipelineFrame FrameAt(double x) {
    t_ns_ += ToNanoseconds(0.5);
    PipelineFrame frame;
    frame.output.calibration.cameras[0].parameters = config_.sensor.cameras[0].parameters;
    frame.output.t_ns = t_ns_;
    frame.output.has_pose = true;
    frame.output.uncertainty.emplace().pose.setIdentity();
    frame.output.state.SetPose({Eigen::Quaterniond::Identity(), {x, 0, 0}});
    frame.images.emplace_back().gray.create(240, 320, CV_8UC1);
    cv::RNG random(static_cast<uint64_t>(t_ns_));
    random.fill(frame.images[0].gray, cv::RNG::UNIFORM, 0, 256);
    return frame;
  }

  int Rows(const std::string& name) const {
    std::istringstream text(folder_.Read(name));
    int rows = 0;
    for (std::string line; std::getline(text, line);) rows += line[0] != '#';
    return rows;
  }

  testing::TemporaryFolder folder_;
  Config config_;
  int64_t t_ns_ = 0;
};

TEST_F(LoopResultsTest, WritesAllFilesOfARun) {
  LoopResults results(config_, folder_.path(), std::nullopt);
  for (int i = 0; i < 4; ++i) results.Add(FrameAt(0.15 * i));
  results.Finish();
  EXPECT_EQ(Rows("trajectory_map.tum"), 4);
  EXPECT_EQ(Rows("covariance_map.csv"), 1 + 4);  // including the header
  EXPECT_EQ(Rows("trajectory_final.tum"), 4);
  EXPECT_THAT(folder_.Read("loops.csv"), HasSubstr("result"));
  const Json summary = results.Summary();
  EXPECT_EQ(summary["keyframes"], 2);  // at 0 and at 0.3 m
  EXPECT_EQ(summary["map_keyframes"], 2);
  EXPECT_EQ(summary["accepted"], 0);
  EXPECT_EQ(summary["first_fix_s"], 0.0);
  EXPECT_EQ(results.Finding(), "");  // no map was loaded
}

TEST_F(LoopResultsTest, WaitsForPoses) {
  LoopResults results(config_, folder_.path(), std::nullopt);
  PipelineFrame without = FrameAt(0);
  without.output.has_pose = false;
  results.Add(without);
  results.Finish();
  EXPECT_EQ(Rows("trajectory_final.tum"), 0);
  EXPECT_TRUE(results.Summary()["first_fix_s"].is_null());
}

TEST_F(LoopResultsTest, MarksUnconnectedWorldsInTheTrajectory) {
  LoopResults results(config_, folder_.path(), std::nullopt);
  for (int i = 0; i < 3; ++i) results.Add(FrameAt(0.4 * i));
  PipelineFrame restarted = FrameAt(0);
  restarted.output.restarted = true;
  restarted.output.reason = "no image for 3 s";
  results.Add(restarted);
  results.Finish();
  EXPECT_THAT(folder_.Read("trajectory_final.tum"), HasSubstr("no image for 3 s"));
  EXPECT_EQ(Rows("trajectory_final.tum"), 4);
  EXPECT_EQ(Rows("trajectory_map.tum"), 3);  // the pose of the new world is unknown
}

TEST_F(LoopResultsTest, StartsInAMap) {
  const std::string file = folder_.File("map.plm");
  {
    LoopResults results(config_, folder_.path(), std::nullopt);
    for (int i = 0; i < 3; ++i) results.Add(FrameAt(0.4 * i));
    SaveMap(file, results.map());
  }
  LoopResults results(config_, folder_.path(), LoadMap(file));
  results.Add(FrameAt(0));
  EXPECT_EQ(results.Summary()["map_keyframes"], 4);
  EXPECT_TRUE(results.Summary()["first_fix_s"].is_null());
  EXPECT_THAT(results.Finding(), StartsWith("the loaded map was never recognized"));
  EXPECT_EQ(results.Line(), "loops: 0 closed of 0 candidates");
  results.Finish();
  // Its only world is not connected with the map, so its pose is not in the map frame.
  EXPECT_THAT(folder_.Read("trajectory_final.tum"), StartsWith("# the world frame starts anew"));
}

TEST_F(LoopResultsTest, NeedsImages) {
  LoopResults results(config_, folder_.path(), std::nullopt);
  PipelineFrame frame = FrameAt(0);
  frame.images.clear();
  EXPECT_THROW(results.Add(frame), std::runtime_error);
}

TEST_F(LoopResultsTest, ErrorNamesAnUnwritableFolder) {
  EXPECT_THAT(
      testing::MessageOf([&] { LoopResults(config_, folder_.File("missing"), std::nullopt); }),
      HasSubstr("missing"));
}

}  // namespace
}  // namespace plm_vins

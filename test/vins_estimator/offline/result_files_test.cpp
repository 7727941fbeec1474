// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/offline/result_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "test/testing/temporary_folder.h"
#include "test/vins_estimator/offline/recording_contents.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;

PipelineFrame MakeFrame(int64_t t_ns, bool has_pose) {
  PipelineFrame frame;
  frame.output.t_ns = t_ns;
  frame.output.has_pose = has_pose;
  frame.output.timings = {1, 2, 4, 8};
  frame.point_tracking_ms = 16;
  return frame;
}

TEST(ResultFiles, AreWrittenFrameByFrame) {
  const testing::TemporaryFolder folder;
  ResultFiles results(folder.File("new/folder"));
  results.Add(MakeFrame(1'000'000'000, false));
  PipelineFrame frame = MakeFrame(2'000'000'000, true);
  frame.output.points = {{1, {1, 1, 1}}, {2, {2, 2, 2}}};
  results.Add(frame);
  frame = MakeFrame(3'000'000'000, true);
  frame.output.points = {{2, {2, 2, 2}}};
  frame.output.departed_points = {{1, {1, 1, 1}}};
  results.Add(frame);
  results.Finish(RunSummary::Run(), Config());

  const std::string trajectory = folder.Read("new/folder/trajectory.tum");
  EXPECT_EQ(trajectory.substr(0, 12), "2.000000000 ");
  EXPECT_EQ(std::count(trajectory.begin(), trajectory.end(), '\n'), 2);
  EXPECT_THAT(
      folder.Read("new/folder/timing.csv"),
      HasSubstr("\n1000000000,16.0000,0.0000,0.0000,1.0000,2.0000,4.0000,8.0000,24.0000\n"));
  EXPECT_THAT(folder.Read("new/folder/map.ply"), HasSubstr("element vertex 2 "));
  EXPECT_THAT(folder.Read("new/folder/lines.ply"), HasSubstr("element edge 0\n"));
  EXPECT_EQ(folder.Read("new/folder/lines.obj"), "");

  const auto summary = nlohmann::json::parse(folder.Read("new/folder/summary.json"));
  EXPECT_EQ(summary["frames"], 3);
  EXPECT_EQ(summary["poses"], 2);
  EXPECT_EQ(summary["points"], 2);
  EXPECT_EQ(summary["config"]["estimator"]["window_size"], EstimatorConfig().window_size);
  EXPECT_FALSE(summary["version"].get<std::string>().empty());
}

TEST(ResultFiles, HoldAnAnnotatedImageWhereThereIsOne) {
  const testing::TemporaryFolder folder;
  const ResultFiles results(folder.File("results"));
  results.WriteAnnotatedImage(cv::Mat());
  EXPECT_TRUE(cv::imread(folder.File("results/tracks.png")).empty());
  results.WriteAnnotatedImage(cv::Mat(20, 30, CV_8UC3, cv::Scalar(0, 0, 255)));
  EXPECT_EQ(cv::imread(folder.File("results/tracks.png")).size(), cv::Size(30, 20));
}

TEST(ResultFiles, NameAFolderThatCannotBeMade) {
  const testing::TemporaryFolder folder;
  folder.Write("file", "");
  EXPECT_THAT(testing::MessageOf([&] { ResultFiles(folder.File("file")); }),
              HasSubstr(folder.File("file")));
  EXPECT_THAT(testing::MessageOf([&] { ResultFiles(folder.File("file/below")); }),
              HasSubstr(folder.File("file/below")));
}

}  // namespace
}  // namespace plm_vins

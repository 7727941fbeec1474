// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/result_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "test/offline/recording_contents.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;
using ::testing::StartsWith;

PipelineFrame MakeFrame(int64_t t_ns, bool has_pose) {
  PipelineFrame frame;
  frame.output.t_ns = t_ns;
  frame.output.has_pose = has_pose;
  if (has_pose) frame.output.uncertainty.emplace().pose.setIdentity();
  frame.output.timings = {1, 128, 2, 4, 8};
  frame.output.counts.points_observed = 7;
  frame.output.counts.points_in_window = 6;
  frame.output.counts.points_rejected = 5;
  frame.output.counts.lines_observed = 53;
  frame.output.counts.line_triangulation = {3, 10, 11, 12, 13};
  frame.output.counts.line_merging = {17, 15, 18, 19, 20, 21, 22, 23};
  frame.output.counts.lines_recognized = 16;
  frame.output.counts.lines_in_window = 40;
  frame.output.counts.lines_rejected = 14;
  frame.output.counts.matched = {71, 72};
  frame.output.counts.depth = {73, 74};
  frame.point_tracking_ms = 16;
  frame.point_tracking = {90, 1, 2, 4, 8, 24};
  frame.line_tracking_ms = 64;
  frame.line_tracking.detection_ms = 32;
  frame.line_tracking.previous = 59;
  frame.line_tracking.match_lost = 1;
  frame.line_tracking.inconsistent = 2;
  frame.line_tracking.edge_lost = 4;
  frame.line_tracking.duplicates = 8;
  frame.line_tracking.candidates = 30;
  frame.line_tracking.added = 9;
  return frame;
}

// Writes the results of these frames.
void WriteResults(const testing::TemporaryFolder& folder,
                  const std::vector<PipelineFrame>& frames) {
  ResultFiles results(folder.path());
  for (const PipelineFrame& frame : frames) results.Add(frame);
  results.Finish(RunSummary::Run(), Config(), Json());
}

TEST(ResultFiles, ATrackImageHasPointsAndLinesSideBySide) {
  const testing::TemporaryFolder folder;
  const cv::Mat blue(40, 60, CV_8UC3, cv::Scalar(255, 0, 0));
  const cv::Mat red(40, 60, CV_8UC3, cv::Scalar(0, 0, 255));
  {
    ResultFiles results(folder.File("run"));
    results.WriteTrackImage(7, blue, red);
    results.WriteTrackImage(8, blue, {});
    results.WriteTrackImage(9, {}, {});
  }
  const cv::Mat both = cv::imread(folder.File("run/tracks/7.jpg"));
  ASSERT_EQ(both.size(), cv::Size(60, 20));
  EXPECT_GT(both.at<cv::Vec3b>(10, 10)[0], 200);
  EXPECT_GT(both.at<cv::Vec3b>(10, 50)[2], 200);
  EXPECT_EQ(cv::imread(folder.File("run/tracks/8.jpg")).size(), cv::Size(30, 20));
  EXPECT_TRUE(cv::imread(folder.File("run/tracks/9.jpg")).empty());
  const ResultFiles next_run(folder.File("run"));
  EXPECT_TRUE(cv::imread(folder.File("run/tracks/7.jpg")).empty());
}

TEST(ResultFiles, ReplaceThoseOfAnEarlierRun) {
  const testing::TemporaryFolder folder;
  for (const char* name : {"trajectory_map.tum", "loops.csv", "summary.json", "line_tracks.png",
                           "tracks/1403636579.jpg"}) {
    folder.Write(name, "of the run before");
  }
  for (const char* name : {"notes.txt", "tracks/gps.log", "tracks/start.jpg"}) {
    folder.Write(name, "of somebody else");
  }
  const ResultFiles results(folder.path());
  EXPECT_FALSE(fs::exists(folder.File("trajectory_map.tum")));
  EXPECT_FALSE(fs::exists(folder.File("loops.csv")));
  EXPECT_FALSE(fs::exists(folder.File("summary.json")));
  EXPECT_FALSE(fs::exists(folder.File("line_tracks.png")));
  EXPECT_FALSE(fs::exists(folder.File("tracks/1403636579.jpg")));
  EXPECT_EQ(folder.Read("notes.txt"), "of somebody else");
  EXPECT_EQ(folder.Read("tracks/gps.log"), "of somebody else");
  EXPECT_EQ(folder.Read("tracks/start.jpg"), "of somebody else");
}

TEST(ResultFiles, HoldASummaryOfARecordingWhoseNameIsNotUtf8) {
  const testing::TemporaryFolder folder;
  ResultFiles results(folder.path());
  RunSummary::Run run;
  run.input = "Aufnahme_\xfc.bag";
  results.Finish(run, Config(), Json());
  EXPECT_THAT(folder.Read("summary.json"), ::testing::HasSubstr("Aufnahme_"));
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
  frame.output.departed_lines = {{1, {1, 1, 1}, {1, 2, 1}}};
  frame.output.lines = {{2, {1, 0, 0}, {2, 0, 0}}, {3, {0, 1, 0}, {0, 2, 0}}};
  results.Add(frame);
  results.Finish(RunSummary::Run(), Config(), {{"loops", {{"accepted", 3}}}});

  const std::string trajectory = folder.Read("new/folder/trajectory.tum");
  EXPECT_EQ(trajectory.substr(0, 12), "2.000000000 ");
  EXPECT_EQ(std::count(trajectory.begin(), trajectory.end(), '\n'), 2);
  EXPECT_THAT(
      folder.Read("new/folder/timing.csv"),
      StartsWith(
          "stamp_ns,point_tracking,line_detection,line_tracking,initialization,line_merging,"
          "optimization,marginalization,estimator,total,points_followed,points_flow_lost,"
          "points_not_back,points_epipolar,points_crowded,points_added,points_observed,"
          "points_in_window,points_rejected,lines_followed,lines_unmatched,lines_off_course,"
          "lines_edge_lost,lines_duplicate,lines_detected,lines_added,lines_observed,"
          "lines_triangulated,lines_degenerate,lines_behind,lines_inconsistent,lines_too_long,"
          "lines_merged,lines_recognized,merge_candidates,merge_other_direction,merge_distant,"
          "merge_apart,merge_distant_in_image,merge_side_by_side,merge_inconsistent,"
          "lines_in_window,lines_rejected,matched_used,matched_rejected,depths_used,"
          "depths_rejected\n"
          "1000000000,16.0000,32.0000,64.0000,1.0000,128.0000,2.0000,4.0000,8.0000,"
          "88.0000,75,1,2,4,8,24,7,6,5,44,1,2,4,8,30,9,53,3,10,11,12,13,15,16,17,18,19,20,"
          "21,22,23,40,14,71,72,73,74\n"));
  EXPECT_THAT(folder.Read("new/folder/map.ply"), HasSubstr("element vertex 2 "));
  EXPECT_THAT(folder.Read("new/folder/lines.ply"), HasSubstr("element edge 3\n"));
  EXPECT_THAT(folder.Read("new/folder/lines.obj"), HasSubstr("v 1.0000 2.0000 1.0000\n"));

  const auto summary = nlohmann::json::parse(folder.Read("new/folder/summary.json"));
  EXPECT_EQ(summary["frames"], 3);
  EXPECT_EQ(summary["poses"], 2);
  EXPECT_EQ(summary["loops"]["accepted"], 3);
  EXPECT_EQ(summary["points"], 2);
  EXPECT_EQ(summary["config"]["window_size"], EstimatorConfig().window_size);
  EXPECT_FALSE(summary["version"].get<std::string>().empty());
}

// A bridged loss keeps the world frame, but starts another window with new landmarks.
TEST(ResultFiles, KeepTheLandmarksOfALostWindow) {
  const testing::TemporaryFolder folder;
  ResultFiles results(folder.path());
  PipelineFrame frame = MakeFrame(1'000'000'000, true);
  frame.output.points = {{1, {1, 1, 1}}, {2, {2, 2, 2}}};
  frame.output.lines = {{1, {1, 1, 1}, {1, 2, 1}}};
  results.Add(frame);
  frame = MakeFrame(2'000'000'000, false);
  frame.output.status = EstimatorStatus::kLost;
  results.Add(frame);
  frame = MakeFrame(3'000'000'000, true);
  frame.output.points = {{3, {3, 3, 3}}};
  results.Add(frame);
  results.Finish(RunSummary::Run(), Config(), Json());
  EXPECT_THAT(folder.Read("map.ply"), HasSubstr("element vertex 3 "));
  EXPECT_THAT(folder.Read("lines.ply"), HasSubstr("element edge 1\n"));
}

TEST(ResultFiles, HoldTheRefinedCalibration) {
  const testing::TemporaryFolder folder;
  Config config;
  config.sensor.estimate_td = true;
  PipelineFrame frame = MakeFrame(1'000'000'000, true);
  frame.output.calibration.td = 0.0123;
  const auto calibrated = [&](const Config& run_config, const PipelineFrame& only_frame) {
    ResultFiles results(folder.File("run"));
    results.Add(only_frame);
    results.Finish(RunSummary::Run(), run_config, Json());
    return folder.Read("run/calibrated.yaml");
  };
  EXPECT_THAT(calibrated(config, frame), HasSubstr("\ntd: 0.0123\n"));
  EXPECT_EQ(calibrated(config, MakeFrame(1'000'000'000, false)), "") << "nothing was found";
  EXPECT_EQ(calibrated(Config(), frame), "") << "nothing was refined";
}

TEST(ResultFiles, KeepPosesBeforeABackwardJumpInSeparateFiles) {
  const testing::TemporaryFolder folder;
  ResultFiles results(folder.path());
  for (const int64_t t : {100, 101, 102}) results.Add(MakeFrame(t * 1'000'000'000, true));
  PipelineFrame restart = MakeFrame(2'000'000'000, false);
  restart.output.restarted = true;
  restart.output.reason = "timestamps jumped back";
  results.Add(restart);
  results.Add(MakeFrame(3'000'000'000, true));
  results.Finish(RunSummary::Run(), Config(), Json());
  EXPECT_EQ(results.trajectory().parts(), 1);
  const std::string before = folder.Read("trajectory_1.tum");
  EXPECT_EQ(std::count(before.begin(), before.end(), '\n'), 3);
  EXPECT_THAT(
      folder.Read("trajectory.tum"),
      ::testing::StartsWith("# the world frame starts anew: timestamps jumped back\n3.0000"));
  const std::string covariance = folder.Read("covariance.csv");
  EXPECT_THAT(covariance, ::testing::StartsWith("stamp_ns,"));
  EXPECT_EQ(std::count(covariance.begin(), covariance.end(), '\n'), 2);
  EXPECT_THAT(folder.Read("covariance_1.csv"), ::testing::StartsWith("stamp_ns,"));
  EXPECT_EQ(nlohmann::json::parse(folder.Read("summary.json"))["poses"], 4);
  const ResultFiles next_run(folder.path());
  EXPECT_FALSE(fs::exists(folder.File("trajectory_1.tum")));
}

// Lines 7 and 8 leave the window with this frame.
PipelineFrame FrameThatLosesTwoLines() {
  PipelineFrame frame = MakeFrame(1'000'000'000, true);
  frame.output.departed_lines = {{7, {1, 0, 0}, {1, 0, 1}}, {8, {2, 0, 0}, {2, 0, 1}}};
  return frame;
}

TEST(ResultFiles, HoldARecognizedLineOnce) {
  const testing::TemporaryFolder folder;
  PipelineFrame departs = MakeFrame(2'000'000'000, true), stays = MakeFrame(3'000'000'000, true);
  departs.output.departed_lines = {{7, {3, 0, 0}, {3, 0, 1}}};
  stays.output.lines = {{8, {4, 0, 0}, {4, 0, 1}}};
  WriteResults(folder, {FrameThatLosesTwoLines(), departs, stays});
  EXPECT_EQ(nlohmann::json::parse(folder.Read("summary.json"))["lines"], 2);
  EXPECT_THAT(folder.Read("lines.ply"), HasSubstr("element edge 2\n"));
  const std::string lines = folder.Read("lines.obj");
  EXPECT_THAT(lines, HasSubstr("v 3.0000 0.0000 1.0000\n"));
  EXPECT_THAT(lines, HasSubstr("v 4.0000 0.0000 1.0000\n"));
}

TEST(ResultFiles, HoldAMergedLineOnce) {
  const testing::TemporaryFolder folder;
  PipelineFrame frame = MakeFrame(2'000'000'000, true);
  frame.output.absorbed_lines = {8, 99};
  frame.output.departed_lines = {{7, {3, 0, 0}, {3, 0, 1}}};
  WriteResults(folder, {FrameThatLosesTwoLines(), frame});
  EXPECT_EQ(nlohmann::json::parse(folder.Read("summary.json"))["lines"], 1);
  EXPECT_THAT(folder.Read("lines.obj"), HasSubstr("v 3.0000 0.0000 1.0000\n"));
}

TEST(ResultFiles, HoldLandmarksOfTheLastFrameOnce) {
  const testing::TemporaryFolder folder;
  PipelineFrame frame = MakeFrame(1'000'000'000, true);
  frame.output.points = frame.output.departed_points = {{1, {1, 1, 1}}};
  frame.output.lines = {{7, {1, 0, 0}, {1, 0, 1}}};
  frame.output.departed_lines = {{7, {1, 0, 0}, {1, 0, 5}}};
  WriteResults(folder, {frame});
  EXPECT_THAT(folder.Read("map.ply"), HasSubstr("element vertex 1 "));
  EXPECT_THAT(folder.Read("lines.ply"), HasSubstr("element edge 1\n"));
  EXPECT_THAT(folder.Read("lines.obj"), HasSubstr("v 1.0000 0.0000 5.0000\n"));
}

TEST(ResultFiles, KeepLinesOfAnEarlierWorldFrame) {
  const testing::TemporaryFolder folder;
  std::vector<PipelineFrame> frames = {MakeFrame(1'000'000'000, true),
                                       MakeFrame(2'000'000'000, false),
                                       MakeFrame(3'000'000'000, true)};
  frames[0].output.departed_lines = {{7, {1, 0, 0}, {1, 0, 1}}};
  frames[0].output.lines = {{8, {2, 0, 0}, {2, 0, 1}}};
  frames[1].output.restarted = true;
  frames[2].output.departed_lines = {{7, {3, 0, 0}, {3, 0, 1}}};
  frames[2].output.lines = {{8, {4, 0, 0}, {4, 0, 1}}};
  WriteResults(folder, frames);
  EXPECT_EQ(nlohmann::json::parse(folder.Read("summary.json"))["lines"], 4);
  const std::string lines = folder.Read("lines.obj");
  for (const std::string x : {"1", "2", "3", "4"}) {
    EXPECT_THAT(lines, HasSubstr("v " + x + ".0000 0.0000 1.0000\n"));
  }
}

TEST(ResultFiles, HoldAnAnnotatedImageIfDrawn) {
  const testing::TemporaryFolder folder;
  ResultFiles results(folder.File("results"));
  results.WriteAnnotatedImage("tracks.png", cv::Mat());
  EXPECT_TRUE(cv::imread(folder.File("results/tracks.png")).empty());
  results.WriteAnnotatedImage("tracks.png", cv::Mat(20, 30, CV_8UC3, cv::Scalar(0, 0, 255)));
  EXPECT_EQ(cv::imread(folder.File("results/tracks.png")).size(), cv::Size(30, 20));
}

TEST(ResultFiles, AreCompleteDespiteAnUnwritablePicture) {
  const testing::TemporaryFolder folder;
  ResultFiles results(folder.path());
  folder.Write("tracks.png/in", "a folder of that name");
  folder.Write("tracks", "a file of that name");
  const cv::Mat picture(20, 30, CV_8UC3, cv::Scalar(0, 0, 255));
  results.WriteAnnotatedImage("tracks.png", picture);
  results.WriteTrackImage(7, picture, {});
  results.Finish(RunSummary::Run(), Config(), Json());
  EXPECT_EQ(results.unwritten_pictures().count, 2);
  EXPECT_EQ(results.unwritten_pictures().detail, folder.File("tracks.png"));
  EXPECT_TRUE(fs::exists(folder.File("summary.json")));
}

}  // namespace
}  // namespace plm_vins

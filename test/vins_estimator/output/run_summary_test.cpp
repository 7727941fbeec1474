// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/run_summary.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

constexpr int64_t kStart = 1'000'000'000'000;
constexpr int64_t kFrame = 50'000'000;  // 20 Hz

EstimatorOutput Pose(int frame, double x) {
  EstimatorOutput output;
  output.t_ns = kStart + frame * kFrame;
  output.has_pose = true;
  output.state.position().x() = x;
  return output;
}

EstimatorOutput NoPose(int frame, const std::string& reason) {
  EstimatorOutput output;
  output.t_ns = kStart + frame * kFrame;
  output.reason = reason;
  return output;
}

TEST(RunSummary, AddsUpARun) {
  RunSummary summary;
  summary.Add(NoPose(0, "too little parallax"), {});
  summary.Add(Pose(1, 0.0), {});
  summary.Add(Pose(2, 0.3), {});
  EstimatorOutput standing = Pose(4, -0.1);
  standing.stationary = true;
  standing.imu_noise = {5e-4, 8e-3, 0, 0};
  standing.counts.line_merging.merged = 2;
  standing.counts.lines_recognized = 3;
  standing.R_W_M = Eigen::Quaterniond::Identity();
  summary.Add(standing, {});

  RunSummary::Run run;
  run.input = "flight.bag";
  run.images = 6;
  run.first_image_ns = kStart - kFrame;
  run.wall_time = 0.1;
  run.map_points = 12;
  run.map_lines = 7;
  run.drops = {{"images_unreadable", 2, "a.png"}, {"imu_gaps", 0, ""}};
  run.findings = {"the cameras seem to be swapped"};
  const auto json = summary.ToJson(run);
  EXPECT_EQ(json["input"], "flight.bag");
  EXPECT_EQ(json["images"], 6);
  EXPECT_EQ(json["frames"], 4);
  EXPECT_EQ(json["poses"], 3);
  EXPECT_EQ(json["points"], 12);
  EXPECT_EQ(json["lines"], 7);
  EXPECT_EQ(json["merged_lines"], 2);
  EXPECT_EQ(json["recognized_lines"], 3);
  EXPECT_NEAR(json["manhattan_share"].get<double>(), 1.0 / 3, 1e-12);
  const ImuNoise usual;
  EXPECT_NEAR(json["imu_noise"]["accel_density"].get<double>(),
              (2 * usual.accel_density + 8e-3) / 3, 1e-12);
  EXPECT_NEAR(json["imu_noise"]["gyro_density"].get<double>(), (2 * usual.gyro_density + 5e-4) / 3,
              1e-12);
  EXPECT_EQ(json["resets"], 0);
  EXPECT_NEAR(json["init_time_s"].get<double>(), 0.1, 1e-9);
  EXPECT_NEAR(json["path_length_m"].get<double>(), 0.7, 1e-12);
  EXPECT_NEAR(json["real_time_factor"].get<double>(), 2.0, 1e-9);
  EXPECT_NEAR(json["standstill_share"].get<double>(), 1.0 / 3, 1e-12);
  EXPECT_EQ(json["dropped"]["images_unreadable"], 2);
  EXPECT_EQ(json["dropped"]["imu_gaps"], 0);
  EXPECT_EQ(json["findings"], Json::array({"the cameras seem to be swapped"}));
}

TEST(RunSummary, ClockJumpAddsNoTime) {
  RunSummary summary;
  for (const int frame : {0, 1, 2, -2000, -1999, 1'000'000, 1'000'002}) {
    summary.Add(Pose(frame, 0.0), {});
  }
  RunSummary::Run run;
  run.wall_time = 0.5;
  const auto json = summary.ToJson(run);
  EXPECT_NEAR(json["duration_s"].get<double>(), 5 * 0.05, 1e-9);
  EXPECT_NEAR(json["real_time_factor"].get<double>(), 0.5, 1e-9);
}

TEST(RunSummary, JumpToANewWorldFrameAddsNoPathLength) {
  RunSummary summary;
  summary.Add(Pose(0, 0.0), {});
  summary.Add(Pose(1, 1.0), {});
  EstimatorOutput restarted = Pose(2, 50.0);
  restarted.restarted = true;
  summary.Add(restarted, {});
  summary.Add(Pose(3, 50.5), {});
  const auto json = summary.ToJson({});
  EXPECT_NEAR(json["path_length_m"].get<double>(), 1.5, 1e-12);
  EXPECT_EQ(json["resets"], 1);
}

TEST(RunSummary, BridgedLossAddsPathLength) {
  RunSummary summary;
  summary.Add(Pose(0, 0.0), {});
  summary.Add(NoPose(1, "lost"), {});
  EstimatorOutput bridged = Pose(2, 2.0);
  bridged.bridged = true;
  summary.Add(bridged, {});
  const auto json = summary.ToJson({});
  EXPECT_NEAR(json["path_length_m"].get<double>(), 2.0, 1e-12);
  EXPECT_EQ(json["bridged_losses"], 1);
  EXPECT_EQ(json["resets"], 0);
}

TEST(RunSummary, HasTheLastCalibration) {
  RunSummary summary;
  summary.Add(Pose(0, 0), {});
  EstimatorOutput refined = Pose(1, 0);
  CameraCalibration& camera = refined.calibration.cameras.front();
  camera.T_B_C = {Eigen::Quaterniond(0, 1, 0, 0), {0.1, 0.2, 0.3}};
  refined.calibration.td = 0.004;
  Intrinsics intrinsics;
  intrinsics << 460, 461, 370, 240, -0.3, 0.1, 0.01, 0.02;
  camera.parameters = camera.parameters.With(intrinsics);
  refined.calibration.cameras.push_back(camera);
  summary.Add(refined, {});
  summary.Add(NoPose(2, "lost"), {});
  const auto calibration = summary.ToJson({})["calibration"];
  EXPECT_EQ(calibration["q_B_C_xyzw"].get<std::vector<double>>(),
            (std::vector<double>{1, 0, 0, 0}));
  EXPECT_EQ(calibration["p_B_C_m"].get<std::vector<double>>(),
            (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(calibration["fx_fy_cx_cy_px"].get<std::vector<double>>(),
            (std::vector<double>{460, 461, 370, 240}));
  EXPECT_EQ(calibration["distortion"].get<std::vector<double>>(),
            (std::vector<double>{-0.3, 0.1, 0.01, 0.02}));
  EXPECT_EQ(calibration["td_s"], 0.004);
  EXPECT_EQ(calibration["camera1"]["p_B_C_m"], calibration["p_B_C_m"]);
  EXPECT_TRUE(RunSummary().ToJson({})["calibration"].is_null());
}

TEST(RunSummary, StatesTheReasonWithoutAPose) {
  RunSummary summary;
  summary.Add(NoPose(0, "too little parallax"), {});
  EXPECT_EQ(summary.poses(), 0);
  EXPECT_EQ(summary.last_reason(), "too little parallax");
  EXPECT_TRUE(summary.ToJson({})["init_time_s"].is_null());
  EXPECT_EQ(RunSummary().ToJson({})["real_time_factor"], 0.0);
}

TEST(RunSummary, HasStatisticsOfEachColumn) {
  const auto columns = [](double tracking, double total, int lines) {
    return FrameColumns{{{"point_tracking", tracking}, {"total", total}}, {{"lines", lines}}};
  };
  RunSummary summary(columns(0, 0, 0));
  for (const auto& frame : {columns(1, 4, 30), columns(2, 5, 50), columns(3, 6, 10)}) {
    EstimatorOutput output = Pose(0, 0);
    output.counts.points_observed = 100;
    summary.Add(output, frame);
  }
  const auto json = summary.ToJson({});
  EXPECT_EQ(json["points_per_frame"], 100.0);
  EXPECT_EQ(json["timing_ms"].size(), 2);
  EXPECT_EQ(json["timing_ms"]["point_tracking"]["mean"], 2.0);
  EXPECT_EQ(json["timing_ms"]["total"]["p95"], 6.0);
  EXPECT_EQ(json["timing_ms"]["total"]["p99"], 6.0);
  EXPECT_EQ(json["counts_per_frame"].size(), 1);
  EXPECT_EQ(json["counts_per_frame"]["lines"]["mean"], 30.0);
  EXPECT_EQ(json["counts_per_frame"]["lines"]["median"], 30.0);
}

}  // namespace
}  // namespace plm_vins

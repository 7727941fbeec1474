// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "test/common/config/config_files.h"
#include "test/common/config/config_fixture.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// ---- Valid configurations ----------------------------------------------------------------------

TEST_F(ConfigTest, ShortFileGivesTheDefaults) {
  const Config config = Load(kShortFile);
  EXPECT_EQ(config.sensor.cameras[0].image_topic, "/image");
  EXPECT_EQ(config.sensor.cameras[0].parameters.width, 640);
  EXPECT_EQ(config.sensor.estimate_extrinsic, SensorConfig::ExtrinsicMode::kCalibrateRotation);
  EXPECT_EQ(config.points.max_cnt, PointTrackerConfig().max_cnt);
  EXPECT_EQ(config.sensor.imu_noise.gyro_density, ImuNoise().gyro_density);
  EXPECT_TRUE(config.warnings.empty());
}

TEST_F(ConfigTest, VinsMonoFileLoadsUnchanged) {
  const Config config = Load(kVinsMonoFile);
  EXPECT_EQ(config.sensor.imu_topic, "/imu0");
  EXPECT_EQ(config.sensor.cameras[0].parameters.model, CameraParameters::Model::kPinholeRadtan);
  EXPECT_EQ(config.sensor.cameras[0].parameters.fx, 461.6);
  EXPECT_EQ(config.sensor.cameras[0].parameters.cy, 248.1);
  EXPECT_MATRIX_NEAR(config.sensor.cameras[0].parameters.distortion,
                     Eigen::Vector4d(-0.2917, 0.08228, 5.333e-5, -1.578e-4), 0.0);
  EXPECT_EQ(config.sensor.estimate_extrinsic, SensorConfig::ExtrinsicMode::kRefine);
  const Eigen::Vector3d optical_axis(0.00414029679422, 0.025715529948, 0.999660727178);
  EXPECT_MATRIX_NEAR(config.sensor.cameras[0].T_B_C.R().col(2), optical_axis, 1e-9);
  EXPECT_EQ(config.sensor.cameras[0].T_B_C.translation.y(), -0.064676986768);
  EXPECT_EQ(config.publish_rate, 10);
  EXPECT_EQ(config.sensor.td, 0.005);
  EXPECT_TRUE(config.sensor.estimate_td);
  EXPECT_NEAR(config.sensor.imu_noise.gyro_density, 0.004 / std::sqrt(200), 1e-15);
  EXPECT_EQ(config.sensor.gravity_norm, 9.81007);
}

TEST_F(ConfigTest, TheReadoutTimeCountsWithARollingShutter) {
  const std::string readout = "rolling_shutter_tr: 0.03\n";
  EXPECT_EQ(Load(kShortFile + readout).sensor.ReadoutTime(), 0);
  EXPECT_EQ(Load(kShortFile + readout + "rolling_shutter: 1\n").sensor.ReadoutTime(), 0.03);
}

TEST_F(ConfigTest, WarnsWhereTheDistortionLeavesTheImageWithoutRays) {
  const std::string folded = Replaced(kShortFile, "k1: 0", "k1: -0.5");
  EXPECT_THAT(
      Load(folded).warnings,
      ElementsAre(AllOf(HasSubstr("camera.yaml:4: model_type: "),
                        HasSubstr(" % of the image has no viewing ray with this distortion"))));
  const std::string hardly = Replaced(kShortFile, "k1: 0", "k1: -0.15");
  EXPECT_TRUE(Load(hardly).warnings.empty());
}

TEST_F(ConfigTest, PixelsBeyondAFisheyesRimAreNoWarning) {
  std::string wide = Replaced(kShortFile, "PINHOLE", "EQUIDISTANT");
  wide = Replaced(wide, "fx: 400, fy: 400", "fx: 150, fy: 150");
  wide = Replaced(wide, "p1: 0, p2: 0", "k3: 0, k4: 0");
  EXPECT_TRUE(Load(wide).warnings.empty());
  EXPECT_EQ(Load(Replaced(wide, "k2: 0", "k2: -0.15")).warnings.size(), 1u);
}

TEST_F(ConfigTest, IgnoredKeysOfVinsMonoAndPlVinsAreOneWarning) {
  const std::string file = (folder_ / "camera.yaml").string();
  const std::string of_pl_vins =
      "ex_calib_result_path: a\npattern_file: b\nvoc_file: c\nmin_loop_num: 25\n";
  EXPECT_THAT(Load(kVinsMonoFile + of_pl_vins).warnings,
              ElementsAre(file + ": keys without effect: camera_name, ex_calib_result_path, "
                                 "fast_relocalization, max_solver_time, min_loop_num, output_path, "
                                 "pattern_file, save_image, visualize_camera_size, "
                                 "visualize_imu_forward, voc_file"));
}

TEST_F(ConfigTest, LoopClosureHasTheKeysOfVins) {
  const PoseGraphConfig config = Load(kVinsMonoFile).pose_graph;
  EXPECT_TRUE(config.loop_closure);
  EXPECT_FALSE(config.load_previous);
  EXPECT_EQ(config.MapFile(), "/home/somebody/output/pose_graph/pose_graph.plm");
  EXPECT_FALSE(Load(kShortFile).pose_graph.loop_closure);
}

TEST_F(ConfigTest, MapAndWorldFramesMustDiffer) {
  EXPECT_EQ(Load(std::string(kShortFile) + "world_frame: map\n").output.world_frame, "map");
  ExpectProblem("world_frame: map\nloop_closure: 1", {"map_frame: is the same as world_frame"});
}

// VINS-Mono has its own mask for fisheyes.
TEST_F(ConfigTest, FisheyeOfVinsWorksWithoutAMask) {
  const Config config = Load(kShortFile + std::string("fisheye: 1\n"));
  EXPECT_THAT(config.warnings, ElementsAre(AllOf(HasSubstr("camera.yaml:10: fisheye: "),
                                                 HasSubstr("fisheye_mask is not set"))));
  EXPECT_EQ(config.points.fisheye_mask, "");
  EXPECT_FALSE(config.points.fisheye);
}

TEST_F(ConfigTest, KannalaBrandtTakesTheNamesOfVins) {
  const std::string pinhole =
      "projection_parameters: {fx: 400, fy: 400, cx: 320, cy: 240}\n"
      "distortion_parameters: {k1: 0, k2: 0, p1: 0, p2: 0}\n";
  std::string text = Replaced(kShortFile, "PINHOLE", "KANNALA_BRANDT");
  text = Replaced(text, pinhole,
                  "projection_parameters: {k2: 0.1, k3: 0.2, k4: 0.3, k5: 0.4, "
                  "mu: 380, mv: 381, u0: 310, v0: 230}\n");
  const CameraParameters camera = Load(text).sensor.cameras[0].parameters;
  EXPECT_EQ(camera.model, CameraParameters::Model::kPinholeEquidistant);
  EXPECT_MATRIX_NEAR(camera.distortion, Eigen::Vector4d(0.1, 0.2, 0.3, 0.4), 0.0);
  EXPECT_MATRIX_NEAR(Eigen::Vector4d(camera.fx, camera.fy, camera.cx, camera.cy),
                     Eigen::Vector4d(380, 381, 310, 230), 0.0);
}

TEST_F(ConfigTest, EquidistantTakesTheNamesOfKalibr) {
  std::string text = Replaced(kShortFile, "PINHOLE", "EQUIDISTANT");
  text = Replaced(text, "p1: 0, p2: 0", "k3: 0.3, k4: 0.4");
  const CameraParameters camera = Load(text).sensor.cameras[0].parameters;
  EXPECT_EQ(camera.model, CameraParameters::Model::kPinholeEquidistant);
  EXPECT_MATRIX_NEAR(camera.distortion, Eigen::Vector4d(0, 0, 0.3, 0.4), 0.0);
}

TEST_F(ConfigTest, MeiTakesTheNamesOfVins) {
  std::string text = Replaced(kShortFile, "PINHOLE", "MEI\nmirror_parameters:\n   xi: 0.9");
  text = Replaced(text, "fx: 400, fy: 400, cx: 320, cy: 240",
                  "gamma1: 500, gamma2: 501, u0: 310, v0: 230");
  const CameraParameters camera = Load(text).sensor.cameras[0].parameters;
  EXPECT_EQ(camera.model, CameraParameters::Model::kMei);
  EXPECT_EQ(camera.xi, 0.9);
  EXPECT_MATRIX_NEAR(Eigen::Vector4d(camera.fx, camera.fy, camera.cx, camera.cy),
                     Eigen::Vector4d(500, 501, 310, 230), 0.0);
}

TEST_F(ConfigTest, OverridesReplaceScalars) {
  const Config config = Load(kVinsMonoFile, {{"max_cnt", "99"},
                                             {"projection_parameters.fx", "500"},
                                             {"corner_detector", "harris"},
                                             {"zero_velocity_update", "false"}});
  EXPECT_EQ(config.points.max_cnt, 99);
  EXPECT_EQ(config.sensor.cameras[0].parameters.fx, 500);
  EXPECT_EQ(config.points.corner_detector, CornerDetectorType::kHarris);
  EXPECT_FALSE(config.estimator.zero_velocity_update);
}

TEST_F(ConfigTest, LinesHaveTheirKeys) {
  const Config config = Load(kShortFile, {{"line_detector", "edlines"},
                                          {"max_line_cnt", "80"},
                                          {"line_min_length", "0.125"},
                                          {"line_outlier_distance", "20"},
                                          {"line_merging", "0"}});
  EXPECT_TRUE(config.use_lines);
  EXPECT_EQ(config.lines.line_detector, LineDetectorType::kEdLines);
  EXPECT_EQ(config.lines.max_lines, 80);
  EXPECT_EQ(config.lines.min_length, 0.125);
  EXPECT_EQ(config.estimator.line_outlier_distance, 20);
  EXPECT_FALSE(config.estimator.line_merging);
  EXPECT_FALSE(Load(kShortFile, {{"use_lines", "0"}}).use_lines);
}

TEST_F(ConfigTest, AnOverrideCanRepairAValue) {
  EXPECT_EQ(Load(kShortFile + std::string("max_cnt: many\n"), {{"max_cnt", "70"}}).points.max_cnt,
            70);
}

TEST_F(ConfigTest, NoiseMeansWhatTheModelSays) {
  const std::string noise = "acc_n: 0.1\ngyr_n: 0.01\nacc_w: 0.001\ngyr_w: 0.0001\n";
  const auto gyro = [&](const std::string& more) {
    return Load(kShortFile + noise + more).sensor.imu_noise.gyro_density;
  };
  EXPECT_EQ(gyro("imu_noise_model: continuous\n"), 0.01);
  EXPECT_NEAR(gyro("imu_noise_model: vins\nimu_rate: 400\n"), 0.01 / 20, 1e-15);
  EXPECT_NEAR(gyro(""), 0.01 / std::sqrt(200), 1e-15);
}

TEST_F(ConfigTest, MaskIsRelativeToTheFileAndCanBeSwitchedOff) {
  std::ofstream(folder_ / "mask.png") << "x";
  const std::string text = std::string(kShortFile) + "fisheye_mask: mask.png\n";
  EXPECT_EQ(Load(text).points.fisheye_mask, (folder_ / "mask.png").string());
  EXPECT_EQ(Load(text + "fisheye: 1\n").points.fisheye_mask, (folder_ / "mask.png").string());
  const Config without = Load(text + "fisheye: 0\n");
  EXPECT_EQ(without.points.fisheye_mask, "");
  EXPECT_THAT(without.warnings, ElementsAre(HasSubstr("fisheye_mask: has no effect")));
}

// ---- Invalid configurations --------------------------------------------------------------------

TEST_F(ConfigTest, MissingFile) {
  ExpectOneProblem(ProblemsOf((folder_ / "nothing.yaml").string()),
                   {"nothing.yaml", "cannot be read"});
  ExpectOneProblem(ProblemsOf("nothing.yaml"),
                   {(std::filesystem::current_path() / "nothing.yaml").string()});
  ExpectOneProblem(ProblemsOf(folder_.string()), {folder_.string(), "is not a regular file"});
}

TEST_F(ConfigTest, NotAConfiguration) {
  ExpectOneProblem(ProblemsOf(Write("")), {"camera.yaml", "no \"key: value\" lines"});
  ExpectOneProblem(ProblemsOf(Write("- 1\n- 2\n")), {"no \"key: value\" lines"});
}

TEST_F(ConfigTest, DuplicateKey) {
  ExpectProblem("td: 0.1\ntd: 0.2", {"camera.yaml:11", "td: appears twice", "camera.yaml:10"});
}

TEST_F(ConfigTest, UnknownKeySuggestsTheNearest) {
  ExpectProblem("max_count: 100", {"camera.yaml:10", "max_count: unknown key", "mean max_cnt?"});
  ExpectProblem("fx: 100", {"mean projection_parameters.fx?"});
  ExpectProblem("color_of_the_sky: blue", {"unknown key; remove it"});
}

TEST_F(ConfigTest, WrongType) {
  ExpectProblem("max_cnt: many", {"camera.yaml:10", "max_cnt: \"many\" is not a number", "150"});
  ExpectProblem("max_cnt: 100.5", {"\"100.5\" is not a whole number"});
  ExpectProblem("min_dist: [1, 2]", {"min_dist: is not a number"});
  ExpectProblem("min_dist:", {"min_dist: is not a number"});
  ExpectProblem("equalize: 2", {"\"2\" must be 0 or 1", "default 1"});
  ExpectProblem("corner_detector: fast", {"must be one of shi_tomasi, harris"});
  ExpectProblem("line_detector: hough", {"must be one of fld, lsd, edlines"});
  ExpectProblem("world_frame: [a]", {"world_frame: must be a string"});
}

TEST_F(ConfigTest, OutOfRange) {
  ExpectProblem("acc_n: 0\ngyr_n: 0.1\nacc_w: 0.1\ngyr_w: 0.1",
                {"must be 1e-06 to 10 [m/s^2/sqrt(Hz); vins: m/s^2] (default 0.002)"});
  ExpectProblem("max_cnt: 0", {"\"0\" out of range, must be 20 to 5000 [corners] (default 150)"});
  ExpectProblem("imu_rate: 20", {"\"20\" out of range, must be 25 to 10000 [Hz]"});
  ExpectProblem("td: -1.5", {"must be -1 to 1 [s]"});
  ExpectProblem("g_norm: 981", {"must be 9 to 10.5 [m/s^2]"});
  ExpectProblem("max_line_cnt: 0", {"must be 1 to 5000 [lines] (default 45)"});
}

TEST_F(ConfigTest, NotFinite) {
  ExpectProblem("td: .nan", {"\".nan\" is not finite"});
  ExpectProblem("point_noise: .inf", {"\".inf\" is not finite"});
  ExpectProblem("point_noise: nan", {"point_noise: \"nan\" is not a number"});
}

TEST_F(ConfigTest, ReportsEveryMissingKey) {
  std::vector<std::string> missing;
  for (const std::string& problem : ProblemsOf(Write("%YAML:1.0\nmodel_type: PINHOLE\n"))) {
    ASSERT_NE(problem.find("is missing"), std::string::npos) << problem;
    const size_t start = problem.find(": ") + 2;
    missing.push_back(problem.substr(start, problem.find(": is missing") - start));
  }
  std::sort(missing.begin(), missing.end());
  const std::vector<std::string> expected = {"distortion_parameters.k1",
                                             "distortion_parameters.k2",
                                             "distortion_parameters.p1",
                                             "distortion_parameters.p2",
                                             "extrinsicRotation",
                                             "extrinsicTranslation",
                                             "image_height",
                                             "image_topic",
                                             "image_width",
                                             "imu_topic",
                                             "projection_parameters.cx",
                                             "projection_parameters.cy",
                                             "projection_parameters.fx",
                                             "projection_parameters.fy"};
  EXPECT_EQ(missing, expected);
}

TEST_F(ConfigTest, ModelTypeMissingOrMisspelt) {
  ExpectOneProblem(ProblemsOf(Write(Replaced(kShortFile, "model_type: PINHOLE\n", ""))),
                   {"model_type: is missing"});
  ExpectOneProblem(ProblemsOf(Write(Replaced(kShortFile, "PINHOLE", "pinhole"))),
                   {"camera.yaml:4", "\"pinhole\" must be one of PINHOLE"});
}

TEST_F(ConfigTest, WithoutAModelMissingGroupsAreNamed) {
  for (const std::string model : {"", "model_type: pinhole\n"}) {
    const std::string all =
        ConfigError(ProblemsOf(Write(model + "image_topic: /image\nfoo: 1\n"))).what();
    for (const std::string key :
         {"model_type", "foo", "imu_topic", "image_width", "image_height", "extrinsicRotation",
          "extrinsicTranslation", "projection_parameters", "distortion_parameters"}) {
      EXPECT_THAT(all, HasSubstr(": " + key + ": "));
    }
    EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 8) << all;
  }
}

TEST_F(ConfigTest, AGroupWithoutKeysIsOneProblem) {
  const std::string keys = ": {k1: 0, k2: 0, p1: 0, p2: 0}";
  for (const std::string value : {":", ": {}", ": 3"}) {
    const std::string text = Replaced(kShortFile, keys, value);
    const std::string where = "camera.yaml:8: distortion_parameters: ";
    ExpectOneProblem(ProblemsOf(Write(text)),
                     {where + "must be a group of keys, indented below it: k1, k2, p1, p2"});
    EXPECT_THAT(ProblemsOf(Write(Replaced(text, "PINHOLE", "pinhole"))),
                ElementsAre(HasSubstr("model_type"), HasSubstr(where + "is missing")));
  }
}

TEST_F(ConfigTest, AMatrixWithoutNumbersIsOneProblem) {
  const std::string all = "must be an !!opencv-matrix of size 3x3";
  ExpectProblem("extrinsicRotation:", {"camera.yaml:10: extrinsicRotation: " + all});
  ExpectProblem("extrinsicRotation: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d",
                {"camera.yaml:10: extrinsicRotation: " + all + " with 9 numbers in data"});
}

TEST_F(ConfigTest, KeysOfAnotherModel) {
  ExpectProblem("mirror_parameters:\n   xi: 0.9", {"mirror_parameters.xi: unknown key"});
  ExpectOneProblem(
      ProblemsOf(Write(Replaced(kShortFile, "p2: 0", "p2: 0, k3: 0.1"))),
      {"distortion_parameters.k3: is not supported: calibrate with k1, k2, p1, p2 only"});
}

TEST_F(ConfigTest, BadExtrinsics) {
  const auto problems = [&](const std::string& from, const std::string& to) {
    return ProblemsOf(Write(Replaced(kVinsMonoFile, from, to)));
  };
  const std::string row = "0.0148655429818, -0.999880929698, 0.00414029679422,";
  ExpectOneProblem(problems("-0.9998", "-1.1"),
                   {"camera.yaml:24: extrinsicRotation", "is not a rotation"});
  ExpectOneProblem(problems(row, "-0.0148655429818, 0.999880929698, -0.00414029679422,"),
                   {"is not a rotation"});
  ExpectOneProblem(problems(row, "0.0, -1.0,"), {"of size 3x3 with 9 numbers"});
  ExpectOneProblem(problems("cols: 1", "cols: 2"), {"extrinsicTranslation", "of size 3x1"});
  ExpectOneProblem(problems("-0.0216401454975", "abc"), {"entry 1 of data is not a finite number"});
  ExpectOneProblem(problems("-0.0216401454975", ".nan"),
                   {"entry 1 of data is not a finite number"});
  ExpectOneProblem(problems("-0.0216401454975", "-20"), {"each must be -10 to 10 [m]"});
  ExpectProblem("extrinsicRotation: 3", {"must be an !!opencv-matrix of size 3x3"});
}

TEST_F(ConfigTest, Contradictions) {
  ExpectProblem("rolling_shutter: 1", {"rolling_shutter_tr: is 0; give the read-out time"});
  ExpectProblem("acc_n: 0.1\ngyr_n: 0.1\nacc_w: 0.1", {"gyr_w: is missing; give all of"});
  ExpectProblem("base_frame: camera", {"base_frame: is the same as camera_frame"});
  ExpectProblem("manhattan_frame: body", {"manhattan_frame: is the same as body_frame"});
  ExpectProblem("world_frame: my world", {"world_frame: must be a name without spaces"});
  ExpectProblem("world_frame: \"map\\n\"", {"world_frame: must be a name without spaces"});
  ExpectProblem("body_frame: \"\"", {"body_frame: is empty; give a name"});
  ExpectProblem("world_frame: /map", {"world_frame: must not begin with a slash"});
  ExpectProblem("min_dist: 490", {"min_dist: must be smaller than the image"});
  ExpectProblem("fisheye_mask: no.png", {"fisheye_mask: cannot find the file", "no.png"});
  ExpectOneProblem(ProblemsOf(Write(Replaced(kShortFile, "cx: 320", "cx: 700"))),
                   {"camera.yaml:5: image_width: the principal point is beyond the right edge; "
                    "correct it or the image size"});
  ExpectOneProblem(ProblemsOf(Write(Replaced(kShortFile, "/imu\"", "/image\""))),
                   {"imu_topic: is the same as image_topic"});
  ExpectOneProblem(ProblemsOf(Write(Replaced(kShortFile, "\"/image\"", "\"\""))),
                   {"image_topic: is empty; give a name"});
}

TEST_F(ConfigTest, OverridesAreChecked) {
  const std::string file = Write(kShortFile);
  ExpectOneProblem(ProblemsOf(file, {{"max_cnt", "-3"}}), {"--set max_cnt: \"-3\" out of range"});
  ExpectOneProblem(ProblemsOf(file, {{"maxcnt", "100"}}),
                   {"--set maxcnt: unknown key; did you mean max_cnt?"});
  try {
    LoadConfig(file, {{"max_cnt", "-3"}}, "parameter /tracker/set/");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.problems()[0].rfind("parameter /tracker/set/max_cnt: \"-3\" out", 0), 0u);
  }
}

TEST_F(ConfigTest, AllProblemsAtOnce) {
  std::string text = Replaced(kVinsMonoFile, "image_topic: \"/cam0/image_raw\"\n", "");
  text = Replaced(text, "min_dist: 30", "min_dist: -30");
  text = Replaced(text, "equalize: 1", "equalise: 1");
  text = Replaced(text, "gyr_n: 0.004", "gyr_n: low");
  text = Replaced(text, "rolling_shutter: 0", "rolling_shutter: 1");
  text = Replaced(text, "0.999660727178", "0.9");
  const std::string file = Write(text + "max_cnt: 1\n");
  const auto problems = ProblemsOf(file, {{"window_size", "1000"}});
  const std::string all = ConfigError(problems).what();
  for (const char* key : {"image_topic", "min_dist", "equalise", "gyr_n", "rolling_shutter_tr",
                          "extrinsicRotation", "max_cnt", "window_size"}) {
    EXPECT_NE(all.find(std::string(" ") + key + ": "), std::string::npos) << key;
  }
  EXPECT_EQ(problems.size(), 8u) << all;
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 7);
  for (const auto& problem : problems) {
    EXPECT_TRUE(problem.rfind(file, 0) == 0 || problem.rfind("--set window_size", 0) == 0);
  }
}

}  // namespace
}  // namespace plm_vins

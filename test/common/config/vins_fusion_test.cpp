// SPDX-License-Identifier: BSD-3-Clause
// The second camera and depth, by the key names of VINS-Fusion and of this package.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/config/config_writer.h"
#include "test/common/config/config_files.h"
#include "test/common/config/config_fixture.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

constexpr const char* kVinsFusionFile = R"(%YAML:1.0

imu: 1
num_of_cam: 2

imu_topic: "/imu0"
image0_topic: "/cam0/image_raw"
image1_topic: "/cam1/image_raw"
output_path: "/home/somebody/output/"

cam0_calib: "left.yaml"
cam1_calib: "right.yaml"
image_width: 752
image_height: 480

estimate_extrinsic: 0
body_T_cam0: !!opencv-matrix
   rows: 4
   cols: 4
   dt: d
   data: [0, -1, 0, -0.02,
          1, 0, 0, -0.06,
          0, 0, 1, 0.01,
          0, 0, 0, 1]
body_T_cam1: !!opencv-matrix
   rows: 4
   cols: 4
   dt: d
   data: [0, -1, 0, -0.02,
          1, 0, 0, 0.05,
          0, 0, 1, 0.01,
          0, 0, 0, 1]

multiple_thread: 1
use_gpu: 0
max_cnt: 150
min_dist: 30
freq: 10
F_threshold: 1.0
show_track: 1
flow_back: 1
max_solver_time: 0.04
max_num_iterations: 8
keyframe_parallax: 10.0
acc_n: 0.1
gyr_n: 0.01
acc_w: 0.001
gyr_w: 0.0001
g_norm: 9.81007
estimate_td: 0
td: 0.0
load_previous_pose_graph: 0
pose_graph_save_path: "/home/somebody/output/pose_graph/"
save_image: 1
)";

constexpr const char* kLeft = R"(%YAML:1.0
---
model_type: PINHOLE
camera_name: camera
image_width: 752
image_height: 480
distortion_parameters:
   k1: -0.29
   k2: 0.08
   p1: -0.0002
   p2: 0.0001
projection_parameters:
   fx: 461.5
   fy: 460.5
   cx: 363.0
   cy: 248.0
)";

constexpr const char* kRight = R"(%YAML:1.0
---
model_type: KANNALA_BRANDT
camera_name: camera
image_width: 752
image_height: 480
projection_parameters:
   k2: 0.01
   k3: 0.02
   k4: -0.03
   k5: 0.04
   mu: 459.5
   mv: 458.5
   u0: 379.0
   v0: 256.0
)";

class VinsFusionTest : public ConfigTest {
 protected:
  void SetUp() override {
    ConfigTest::SetUp();
    WriteAs("left.yaml", kLeft);
    WriteAs("right.yaml", kRight);
  }

  void WriteAs(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  void ExpectProblemOf(const std::string& text, const std::vector<std::string>& words) const {
    ExpectOneProblem(ProblemsOf(Write(text)), words);
  }

  std::string PathOf(const std::string& name) const { return (folder_ / name).string(); }
};

void ExpectRightCamera(const SensorConfig& sensor) {
  ASSERT_EQ(sensor.cameras.size(), 2u);
  const CameraSensor& right = sensor.cameras[1];
  EXPECT_EQ(right.image_topic, "/cam1/image_raw");
  EXPECT_EQ(right.parameters.model, CameraParameters::Model::kPinholeEquidistant);
  EXPECT_EQ(right.parameters.width, 752);
  EXPECT_EQ(right.parameters.fx, 459.5);
  EXPECT_MATRIX_NEAR(right.parameters.distortion, Eigen::Vector4d(0.01, 0.02, -0.03, 0.04), 0.0);
  EXPECT_MATRIX_NEAR(right.T_B_C * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-0.02, 1.05, 0.01),
                     1e-12);
}

TEST_F(VinsFusionTest, LoadsUnchanged) {
  const Config config = Load(kVinsFusionFile);
  const SensorConfig& sensor = config.sensor;
  EXPECT_EQ(sensor.cameras[0].image_topic, "/cam0/image_raw");
  EXPECT_EQ(sensor.cameras[0].parameters.fx, 461.5);
  EXPECT_EQ(sensor.cameras[0].parameters.distortion[2], -0.0002);
  EXPECT_MATRIX_NEAR(sensor.cameras[0].T_B_C * Eigen::Vector3d(1, 0, 0),
                     Eigen::Vector3d(-0.02, 0.94, 0.01), 1e-12);
  EXPECT_FALSE(sensor.depth);
  ExpectRightCamera(sensor);
  EXPECT_THAT(config.warnings,
              ElementsAre(PathOf("camera.yaml") +
                          ": keys without effect: flow_back, max_solver_time, multiple_thread, "
                          "output_path, save_image, use_gpu"));
}

TEST_F(VinsFusionTest, SecondCameraIsIgnoredWithNumOfCamOne) {
  std::string text = Replaced(kVinsFusionFile, "num_of_cam: 2", "num_of_cam: 1");
  text = Replaced(text, "\"right.yaml\"", "\"there is none.yaml\"");
  const Config config = Load(text);
  EXPECT_EQ(config.sensor.cameras.size(), 1u);
  EXPECT_EQ(config.sensor.cameras[0].parameters.fx, 461.5);
  EXPECT_THAT(config.warnings,
              ElementsAre(AllOf(HasSubstr("keys without effect: body_T_cam1, cam1_calib, "),
                                HasSubstr("image1_topic"))));
}

TEST_F(VinsFusionTest, WrittenFileLoadsWithEqualValues) {
  std::ostringstream written;
  Config config = Load(kVinsFusionFile);
  WriteConfig(config, &written);
  const Config again = Load(written.str());
  EXPECT_TRUE(again.warnings.empty());
  ExpectRightCamera(again.sensor);
  EXPECT_EQ(EffectiveValues(again).size(), EffectiveValues(config).size());

  config.sensor.cameras.resize(1);
  config.sensor.depth = DepthSensor{"/depth", 0.004, 0.0002, 9};
  written.str("");
  WriteConfig(config, &written);
  const SensorConfig sensor = Load(written.str()).sensor;
  EXPECT_EQ(sensor.cameras.size(), 1u);
  ASSERT_TRUE(sensor.depth);
  EXPECT_EQ(sensor.depth->topic, "/depth");
  EXPECT_EQ(sensor.depth->noise, 0.004);
  EXPECT_EQ(sensor.depth->unit, 0.0002);
  EXPECT_EQ(sensor.depth->max, 9);
}

TEST_F(VinsFusionTest, OverridesReplaceValuesOfACameraFile) {
  const Config config = Load(kVinsFusionFile, {{"projection_parameters.fx", "470"},
                                               {"cam1_projection_parameters.mu", "471"},
                                               {"image_topic", "/other"}});
  EXPECT_EQ(config.sensor.cameras[0].parameters.fx, 470);
  EXPECT_EQ(config.sensor.cameras[1].parameters.fx, 471);
  EXPECT_EQ(config.sensor.cameras[0].image_topic, "/other");
  EXPECT_EQ(Load(kVinsFusionFile, {{"num_of_cam", "1"}}).sensor.cameras.size(), 1u);
}

TEST_F(VinsFusionTest, OdometryWithoutImuIsRejected) {
  ExpectProblemOf(Replaced(kVinsFusionFile, "imu: 1", "imu: 0"),
                  {"camera.yaml:3: imu: ", "without an IMU is not supported"});
}

TEST_F(VinsFusionTest, ErrorNamesAMissingCameraFile) {
  const auto problems = ProblemsOf(Write(Replaced(kVinsFusionFile, "left.yaml", "none.yaml")));
  EXPECT_THAT(problems, ElementsAre(HasSubstr(PathOf("none.yaml") + ": cannot be read"),
                                    HasSubstr("camera.yaml:11: cam0_calib: ")));
}

TEST_F(VinsFusionTest, ProblemsOfACameraFileNameIt) {
  WriteAs("right.yaml", Replaced(kRight, "459.5", "-459.5"));
  ExpectProblemOf(kVinsFusionFile,
                  {PathOf("right.yaml") + ":12: projection_parameters.mu: ", "out of range"});
  WriteAs("right.yaml", Replaced(kRight, "KANNALA_BRANDT", "SCARAMUZZA"));
  EXPECT_THAT(ProblemsOf(Write(kVinsFusionFile)),
              ::testing::Contains(AllOf(HasSubstr(PathOf("right.yaml") + ":3: model_type: "),
                                        HasSubstr("must be one of"))));
  WriteAs("right.yaml", kRight);
  WriteAs("left.yaml", Replaced(kLeft, "   p1:", "   k3: 0.1\n   p1:"));
  ExpectProblemOf(kVinsFusionFile,
                  {PathOf("left.yaml") + ":10: distortion_parameters.k3: ", "is not supported"});
}

TEST_F(VinsFusionTest, ContradictionsAreListedAllAtOnce) {
  std::string text = Replaced(kVinsFusionFile, "image_width: 752", "image_width: 640");
  text = Replaced(text, "/cam1/image_raw", "/imu0");
  text = Replaced(text, "1, 0, 0, 0.05,", "1, 0, 0, -0.06,");
  text += "image_topic: /left\n";
  EXPECT_THAT(
      ProblemsOf(Write(text)),
      UnorderedElementsAre(
          AllOf(HasSubstr("image0_topic: contradicts "), HasSubstr("image_topic; remove one")),
          AllOf(HasSubstr("left.yaml:5: image_width: contradicts "), HasSubstr("camera.yaml:13")),
          HasSubstr("imu_topic: is the same as image1_topic"),
          HasSubstr("body_T_cam1: equals the transform of camera 0; correct one of them")));
}

TEST_F(VinsFusionTest, InvalidTransformIsOneProblem) {
  ExpectProblemOf(Replaced(kVinsFusionFile, "0, 0, 1, 0.01", "0, 0, 2, 0.01"),
                  {"body_T_cam0: is not a rotation"});
  ExpectProblemOf(Replaced(kVinsFusionFile, "0, 0, 0, 1]", "0, 0, 0, 2]"),
                  {"body_T_cam0: must have 0, 0, 0, 1 as its last row"});
  const std::string second = Replaced(kVinsFusionFile, "1, 0, 0, 0.05,", "1, 0, 0, 50,");
  ExpectProblemOf(second, {"body_T_cam1: out of range"});
}

TEST_F(VinsFusionTest, ASecondCameraNeedsItsKeys) {
  const std::string text = std::string(kShortFile) + "num_of_cam: 2\n";
  std::vector<std::string> problems = ProblemsOf(Write(text));
  for (const char* key :
       {"image1_topic", "cam1_model_type", "cam1_image_width", "cam1_image_height",
        "cam1_projection_parameters", "cam1_distortion_parameters", "body_T_cam1",
        "extrinsicRotation", "extrinsicTranslation"}) {
    EXPECT_THAT(problems, ::testing::Contains(HasSubstr(std::string(": ") + key + ": is missing")));
  }
  EXPECT_EQ(problems.size(), 9u);
}

// A rig of `count` cameras; the further ones are copies of the right one at other places.
std::string Rig(int count) {
  std::string text =
      Replaced(kVinsFusionFile, "num_of_cam: 2", "num_of_cam: " + std::to_string(count));
  for (int i = 2; i < count; ++i) {
    const std::string number = std::to_string(i);
    text += "image" + number + "_topic: /cam" + number + "\ncam" + number + "_calib: right.yaml\n";
    text += "body_T_cam" + number +
            ": !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [1, 0, 0, " + number +
            ", 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n";
  }
  return text;
}

TEST_F(VinsFusionTest, LoadsFourCameras) {
  const SensorConfig sensor = Load(Rig(4)).sensor;
  ASSERT_EQ(sensor.cameras.size(), 4u);
  EXPECT_EQ(sensor.cameras[3].image_topic, "/cam3");
  EXPECT_EQ(sensor.cameras[3].parameters.fx, 459.5);
  EXPECT_EQ(sensor.cameras[3].T_B_C.translation.x(), 3);
}

TEST_F(VinsFusionTest, FiveCamerasAreOneProblem) {
  ExpectProblemOf(Rig(5), {"num_of_cam: ", "must be 1 to 4 [cameras]"});
}

TEST_F(VinsFusionTest, AGapInTheNumbersIsOneProblem) {
  std::string text = Replaced(Rig(3), "image2_topic", "image3_topic");
  text = Replaced(Replaced(text, "cam2_calib", "cam3_calib"), "body_T_cam2", "body_T_cam3");
  ExpectProblemOf(text, {"camera 2 has no keys; number the cameras without a gap"});
}

TEST_F(VinsFusionTest, CamerasMayHaveDifferentSizes) {
  WriteAs("right.yaml", Replaced(kRight, "752", "848"));
  EXPECT_EQ(Load(kVinsFusionFile).sensor.cameras[1].parameters.width, 848);
}

TEST_F(VinsFusionTest, MaskIsUsedIfItExists) {
  const std::string text =
      std::string(kVinsFusionFile) + "fisheye: 1\nfisheye_mask_path: mask.png\n";
  EXPECT_THAT(Load(text).warnings,
              ElementsAre(HasSubstr("fisheye_mask_path"), HasSubstr("fisheye_mask is not set")));
  WriteAs("mask.png", "x");
  EXPECT_EQ(Load(text).points.fisheye_mask, PathOf("mask.png"));
}

TEST_F(VinsFusionTest, DepthHasItsKeys) {
  EXPECT_FALSE(Load(std::string(kShortFile) + "depth_max: 4\n").sensor.depth);
  const Config config =
      Load(std::string(kShortFile) + "depth_noise: 0.001\ndepth_topic: /depth\ndepth_max: 4\n");
  ASSERT_TRUE(config.sensor.depth);
  EXPECT_EQ(config.sensor.depth->noise, 0.001);
  EXPECT_EQ(config.sensor.depth->max, 4);
  ExpectProblem("depth_topic: /depth\ndepth_noise: 0", {"depth_noise: \"0\" out of range"});
  ExpectProblem("depth_topic: /image", {"depth_topic: is the same as image_topic"});
}

}  // namespace
}  // namespace plm_vins

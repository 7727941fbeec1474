// SPDX-License-Identifier: BSD-3-Clause
// Configurations that are endless or endlessly nested, and matrices out of range.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <sstream>
#include <string>

#include "test/common/config/config_fixture.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

class ConfigLimitsTest : public ConfigTest {};

TEST_F(ConfigLimitsTest, RejectsCyclicAliases) {
  ExpectOneProblem(ProblemsOf(Write("%YAML:1.0\na: &a\n  b: *a\n")),
                   {"camera.yaml", "a.b", "group"});
}

TEST_F(ConfigLimitsTest, RejectsExponentialAliases) {
  std::ostringstream lists, groups;
  lists << "a0: &a0 {data: 0}\n";
  groups << "g0: &g0 {k: 0}\n";
  for (int i = 1; i < 40; ++i) {
    lists << "a" << i << ": &a" << i << " [*a" << i - 1 << ", *a" << i - 1 << "]\n";
    groups << "g" << i << ": &g" << i << " {k: *g" << i - 1 << ", l: *g" << i - 1 << "}\n";
  }
  EXPECT_FALSE(ProblemsOf(Write(lists.str())).empty());
  ExpectOneProblem(ProblemsOf(Write(groups.str())), {"group within a group"});
  std::string wide = "g: &g {", uses;
  for (int i = 0; i < 500; ++i) {
    wide += "k" + std::to_string(i) + ": 0, ";
    uses += "u" + std::to_string(i) + ": *g\n";
  }
  ExpectOneProblem(ProblemsOf(Write(wide + "z: 0}\n" + uses)), {"too many keys"});
}

// The plane of a mirror with a large xi is small, so coefficients are large: VINS-Fusion's EuRoC.
TEST_F(ConfigLimitsTest, CoefficientsMayBeAsLargeAsTheImageAllows) {
  const auto mei = [](const std::string& k2) {
    std::string text = Replaced(kShortFile, "PINHOLE", "MEI\nmirror_parameters:\n   xi: 3.6313");
    text = Replaced(text, "fx: 400, fy: 400, cx: 320, cy: 240",
                    "gamma1: 2138.8, gamma2: 2135.7, u0: 361.2, v0: 248.3");
    return Replaced(text, "k1: 0, k2: 0", "k1: 0.0646, k2: " + k2);
  };
  EXPECT_EQ(Load(mei("15.492")).sensor.cameras[0].parameters.distortion[1], 15.492);
  ExpectOneProblem(ProblemsOf(Write(mei("9999"))), {"distortion_parameters", "9999"});
  ExpectOneProblem(ProblemsOf(Write(Replaced(kShortFile, "k2: 0", "k2: 15.492"))),
                   {"distortion_parameters", "15.492", "more than ten times"});
}

TEST_F(ConfigLimitsTest, RejectsEndlessFiles) {
  const std::string problem = "is not a regular file; give the path of a configuration file";
  ExpectOneProblem(ProblemsOf("/dev/zero"), {"/dev/zero: " + problem});
  const std::string pipe = (folder_ / "pipe.yaml").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  ExpectOneProblem(ProblemsOf(pipe), {pipe + ": " + problem});
  ExpectOneProblem(ProblemsOf(Write(std::string(2 << 20, '#'))), {"longer than 1 MiB"});
}

TEST_F(ConfigLimitsTest, RejectsOverlongMaskPaths) {
  ExpectProblem("fisheye_mask: " + std::string(5000, 'm'),
                {"fisheye_mask", "cannot find the file"});
}

TEST_F(ConfigLimitsTest, CorrectionsOfTheImuAreMatricesNearOne) {
  EXPECT_TRUE(Load(kShortFile).sensor.imu.gyro_correction.isIdentity(0));
  const std::string head =
      "gyr_correction: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: ";
  const Config config = Load(kShortFile + head + "[1, 2e-2, 0, 0, 0.9, 0, 0, 0, 1.1]\n");
  Eigen::Matrix3d expected;
  expected << 1, 2e-2, 0, 0, 0.9, 0, 0, 0, 1.1;
  EXPECT_MATRIX_NEAR(config.sensor.imu.gyro_correction, expected, 0.0);
  EXPECT_TRUE(config.sensor.imu.accel_correction.isIdentity(0));
  ExpectProblem(head + "[1, 0, 0, 0, 0.4, 0, 0, 0, 1]",
                {"gyr_correction: ", "its scale factors must be 0.5 to 2"});
  ExpectProblem(head + "[0, 1, 0, 0, 1, 0, 0, 0, 1]", {"its scale factors must be 0.5 to 2"});
  ExpectProblem(head + "[0, 1, 0, 1, 0, 0, 0, 0, 1]", {"gyr_correction: mirrors the axes"});
}

}  // namespace
}  // namespace plm_vins

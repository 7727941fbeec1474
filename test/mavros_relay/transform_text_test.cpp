// SPDX-License-Identifier: BSD-3-Clause
#include "mavros_relay/transform_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

std::string ProblemOf(const std::string& text) {
  try {
    ParseTransform("imu_to_base", text);
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(TransformText, TurnsAboutXThenYThenZ) {
  const Rigid3d T =
      ParseTransform("imu_to_base", " 1 -2 3.5  1.5707963267948966 0 3.141592653589793 ");
  EXPECT_MATRIX_NEAR(T.translation, Eigen::Vector3d(1, -2, 3.5), 1e-12);
  EXPECT_MATRIX_NEAR(T.rotation * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 1e-12);
  EXPECT_MATRIX_NEAR(T.rotation * Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0, 0, -1), 1e-12);
  const Rigid3d pitched =
      ParseTransform("imu_to_base", "0 0 0 1.5707963267948966 0.5 0");  // nose down
  EXPECT_MATRIX_NEAR(pitched.rotation * Eigen::Vector3d::UnitX(),
                     Eigen::Vector3d(0, std::cos(0.5), -std::sin(0.5)), 1e-12);
}

TEST(TransformText, RejectsMalformedText) {
  for (const std::string text : {"", "1 2 3", "1 2 3 4 5 6 7", "1 2 3 4 5 x", "a b c d e f"}) {
    EXPECT_EQ(ProblemOf(text),
              "imu_to_base: expected x y z yaw pitch roll [m, rad] instead of \"" + text + "\"");
  }
}

TEST(TransformText, RejectsDegrees) {
  for (const std::string text : {"0 0 0 0 0 180", "0 0 0 -90 0 0", "0 0 0 0 6.4 0"}) {
    EXPECT_EQ(
        ProblemOf(text),
        "imu_to_base: yaw, pitch and roll are in rad and must be at most 2 pi: \"" + text + "\"");
  }
  EXPECT_EQ(ProblemOf("90 0 0 6.2832 -6.2832 0"), "");
}

}  // namespace
}  // namespace plm_vins

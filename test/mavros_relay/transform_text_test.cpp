// SPDX-License-Identifier: BSD-3-Clause
#include "mavros_relay/transform_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

TEST(TransformText, TurnsAboutXThenYThenZ) {
  const Rigid3d T = ParseTransform(" 1 -2 3.5  1.5707963267948966 0 3.141592653589793 ");
  EXPECT_MATRIX_NEAR(T.translation, Eigen::Vector3d(1, -2, 3.5), 1e-12);
  EXPECT_MATRIX_NEAR(T.rotation * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 1e-12);
  EXPECT_MATRIX_NEAR(T.rotation * Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0, 0, -1), 1e-12);
  const Rigid3d pitched = ParseTransform("0 0 0 1.5707963267948966 0.5 0");  // nose down
  EXPECT_MATRIX_NEAR(pitched.rotation * Eigen::Vector3d::UnitX(),
                     Eigen::Vector3d(0, std::cos(0.5), -std::sin(0.5)), 1e-12);
}

TEST(TransformText, RefusesWhatIsNone) {
  for (const char* text : {"", "1 2 3", "1 2 3 4 5 6 7", "1 2 3 4 5 x", "a b c d e f"}) {
    EXPECT_THROW(ParseTransform(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace plm_vins

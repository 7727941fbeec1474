// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/timed_bearing.h"

#include <gtest/gtest.h>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;

TEST(TimedBearing, MovesAlongItsVelocityWithTheTimeOffset) {
  const TimedBearing bearing{{0.1, 0.2}, {1, -2}, 0.01};
  EXPECT_MATRIX_NEAR(bearing.At(0.01), Vector2d(0.1, 0.2), 1e-15);
  EXPECT_MATRIX_NEAR(bearing.At(0.03), Vector2d(0.08, 0.24), 1e-15);
}

}  // namespace
}  // namespace plm_vins

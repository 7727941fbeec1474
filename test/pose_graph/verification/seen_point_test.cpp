// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/seen_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

TEST(SightingError, IsInfiniteBehindTheCamera) {
  const Eigen::Quaterniond R_G_C = testing::LookingAhead().rotation;
  EXPECT_NEAR(SightingError({{2, 0, 0}, {0.1, 0}}, LevelTransform(), R_G_C), 0.1, 1e-12);
  EXPECT_TRUE(std::isinf(SightingError({{-2, 0, 0}, {0.1, 0}}, LevelTransform(), R_G_C)));
}

}  // namespace
}  // namespace plm_vins

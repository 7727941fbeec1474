// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/keyframes/odometry_noise.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

constexpr DriftBudget kBudget = {0.05, 0.02, 0.01, 0.001};

TEST(DriftBudget, ReturnsThePathLengthForADrift) {
  EXPECT_NEAR(kBudget.DistanceOf(kBudget.Variances(30)), 30, 1e-9);
  EXPECT_NEAR(kBudget.DistanceOf({0.01, 4, 0.01, 0}), (2 - 0.05) / 0.02, 1e-9);
  EXPECT_NEAR(kBudget.DistanceOf({0, 0, 0, 0.04}), (0.2 - 0.01) / 0.001, 1e-9);
}

TEST(DriftBudget, ReturnsZeroIfTheFirstStepMayExceedIt) {
  EXPECT_EQ(kBudget.DistanceOf(Vector4d::Zero()), 0);
  EXPECT_EQ(kBudget.DistanceOf(Vector4d::Constant(1e-6)), 0);
}

}  // namespace
}  // namespace plm_vins

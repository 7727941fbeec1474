// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/zero_velocity_factor.h"

#include <gtest/gtest.h>

#include "simulator/random.h"
#include "test/testing/cost_function_check.h"

namespace plm_vins {
namespace {

using testing::Block;
using testing::BlockPlus;

Block RandomPose(simulator::Random* random) {
  Block identity(7), delta(6);
  identity << 0, 0, 0, 0, 0, 0, 1;
  delta << random->NormalVector3(), random->NormalVector3();
  return BlockPlus(identity, delta);
}

TEST(ZeroVelocityFactor, IsTheVelocityInStandardDeviations) {
  Block motion(9);
  motion << 0.02, -0.04, 0.1, 1, 2, 3, 4, 5, 6;
  const ZeroVelocityFactor factor(0.02);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, {motion}), Eigen::Vector3d(1, -2, 5), 1e-12);
  testing::ExpectTangentJacobians(factor, {motion}, 1e-7);
}

TEST(SamePoseFactor, IsZeroForEqualPosesAndScaledByTheDeviations) {
  simulator::Random random(1);
  const Block pose = RandomPose(&random);
  const SamePoseFactor factor(0.01, 0.002);
  EXPECT_TRUE(testing::Residual(factor, {pose, pose}).isZero(1e-12));

  Block delta(6), expected(6);
  delta << 0.01, -0.02, 0, 0, 0.002, -0.004;
  expected << 1, -2, 0, 0, 1, -2;
  EXPECT_MATRIX_NEAR(testing::Residual(factor, {pose, BlockPlus(pose, delta)}), expected, 1e-9);
}

TEST(SamePoseFactor, JacobiansAreExactForLargeDifferences) {
  simulator::Random random(2);
  for (int i = 0; i < 20; ++i) {
    const SamePoseFactor factor(0.5, 2.0);
    Block delta(6);
    delta << random.NormalVector3(), 0.7 * random.NormalVector3();
    const Block pose = RandomPose(&random);
    testing::ExpectTangentJacobians(factor, {pose, BlockPlus(pose, delta)}, 1e-7);
  }
}

}  // namespace
}  // namespace plm_vins

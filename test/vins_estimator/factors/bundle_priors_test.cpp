// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/bundle_priors.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/cost_function_check.h"

namespace plm_vins {
namespace {

using testing::Block;
using testing::BlockPlus;

FrameState RandomState(simulator::Random* random) {
  FrameState state;
  state.SetPose({SO3Exp(random->NormalVector3()), random->NormalVector3()});
  return state;
}

Block PoseOf(const FrameState& state) {
  return Eigen::Map<const Block>(state.pose.data(), kPoseSize);
}

// Rotates the state about an axis of the world.
Block Turned(const FrameState& state, const Eigen::Vector3d& theta_W) {
  FrameState turned = state;
  turned.SetPose({SO3Exp(theta_W) * Eigen::Quaterniond(state.rotation()), state.position()});
  return PoseOf(turned);
}

TEST(GaugePrior, ConstrainsOnlyPositionAndHeading) {
  simulator::Random random(1);
  const FrameState state = RandomState(&random);
  const GaugePrior prior(state, 0.1);
  EXPECT_TRUE(testing::Residual(prior, {PoseOf(state)}).isZero(1e-12));

  Block moved(6);
  moved << 0.1, -0.2, 0.3, 0, 0, 0;
  EXPECT_MATRIX_NEAR(testing::Residual(prior, {BlockPlus(PoseOf(state), moved)}),
                     Eigen::Vector4d(1, -2, 3, 0), 1e-9);
  EXPECT_MATRIX_NEAR(testing::Residual(prior, {Turned(state, {0, 0, 0.2})}),
                     Eigen::Vector4d(0, 0, 0, 2), 1e-9);
  EXPECT_TRUE(testing::Residual(prior, {Turned(state, {0.2, 0.1, 0})}).isZero(1e-9));
}

TEST(GaugePrior, JacobianIsExactForLargeDifferences) {
  simulator::Random random(2);
  for (int i = 0; i < 20; ++i) {
    const FrameState state = RandomState(&random);
    Block delta(6);
    delta << random.NormalVector3(), 0.7 * random.NormalVector3();
    testing::ExpectTangentJacobians(GaugePrior(state, 0.5), {BlockPlus(PoseOf(state), delta)},
                                    1e-7);
  }
}

TEST(BiasPrior, IsTheBiasDifferenceInStandardDeviations) {
  const BiasPrior prior({{0.1, 0.2, 0.3}, {0.01, 0.02, 0.03}}, 0.1, 0.01);
  Block motion(9);
  motion << 7, 8, 9, 0.2, 0.2, 0.1, 0.01, 0.04, 0.02;
  Block expected(6);
  expected << 1, 0, -2, 0, 2, -1;
  EXPECT_MATRIX_NEAR(testing::Residual(prior, {motion}), expected, 1e-9);
  testing::ExpectTangentJacobians(prior, {motion}, 1e-6);
}

}  // namespace
}  // namespace plm_vins

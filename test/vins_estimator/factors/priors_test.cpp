// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/priors.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/cost_function_check.h"
#include "test/vins_estimator/factors/factor_scene.h"

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

using Eigen::Vector3d;
using testing::FactorScene;
using testing::PoseBlockOf;

constexpr ChainKind kOtherCamera = {/*same_frame=*/true, /*same_camera=*/false};

TEST(ExtrinsicsPrior, SplitsThePositionIntoDirectionAndLengthOfTheBaseline) {
  const FactorScene scene(1, kOtherCamera);
  const Rigid3d configured = scene.T_B_Ch.Inverse() * scene.T_B_Ct;
  const ExtrinsicsPrior prior(configured, {/*across=*/0.01, /*along=*/0.1, /*rotation=*/0.02});
  const auto residual = [&](const Rigid3d& T_Ci_Cj) {
    return testing::Residual(prior,
                             {PoseBlockOf(scene.T_B_Ch), PoseBlockOf(scene.T_B_Ch * T_Ci_Cj)});
  };
  EXPECT_TRUE(residual(configured).isZero(1e-9));
  const Rigid3d longer(configured.rotation, 1.1 * configured.translation);
  const double stretch = 0.1 * configured.translation.norm();
  EXPECT_NEAR(residual(longer).norm(), stretch / 0.1, 1e-9);
  const Vector3d across = 0.003 * configured.translation.unitOrthogonal();
  const Rigid3d turned(configured.rotation, configured.translation + across);
  EXPECT_NEAR(residual(turned).norm(), 0.003 / 0.01, 1e-9);
  const Rigid3d rotated(configured.rotation * SO3Exp({0.01, 0, 0}), configured.translation);
  EXPECT_NEAR(residual(rotated).norm(), 0.01 / 0.02, 1e-9);
}

TEST(ExtrinsicsPrior, JacobiansAreExactFarFromTheConfiguredPose) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const FactorScene scene(seed, kOtherCamera), other(seed + 100, kOtherCamera);
    const ExtrinsicsPrior prior(scene.T_B_Ch.Inverse() * scene.T_B_Ct, {0.3, 0.5, 2});
    testing::ExpectTangentJacobians(prior, {PoseBlockOf(other.T_B_Ch), PoseBlockOf(scene.T_B_Ct)},
                                    1e-7);
  }
}

TEST(ExtrinsicsPrior, NeedsNoBaseline) {
  const FactorScene scene(1, kOtherCamera);
  const ExtrinsicsPrior prior({scene.T_B_Ch.rotation, Vector3d::Zero()}, {0.01, 0.01, 0.02});
  const Block body = PoseBlockOf({}), camera = PoseBlockOf({scene.T_B_Ch.rotation, {0, 0, 0.01}});
  EXPECT_NEAR(testing::Residual(prior, {body, camera}).norm(), 1, 1e-9);
}

}  // namespace

}  // namespace plm_vins

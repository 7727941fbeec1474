// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/extrinsics_prior.h"

#include <gtest/gtest.h>

#include "test/vins_estimator/factors/factor_scene.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;
using testing::Block;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/point_factor.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "test/vins_estimator/factors/factor_scene.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Block;
using testing::FactorScene;
using testing::ScalarBlock;

std::vector<Block> Blocks(const FactorScene& scene, double td) {
  return testing::Joined(scene.Poses(), {ScalarBlock(td), scene.Point()});
}

TEST(PointFactor, IsTheWeightedReprojectionError) {
  const Vector2d error(0.001, -0.002), velocity(0.5, 0.3);
  testing::ForEachScene([&](const FactorScene& scene) {
    const TimedBearing seen{scene.SeenInTarget(scene.p_Ch) - error, velocity, 0.02};
    const PointFactor factor(scene.kind, seen, 100);
    ASSERT_EQ(static_cast<size_t>(factor.num_blocks()), Blocks(scene, 0).size());
    EXPECT_MATRIX_NEAR(testing::Residual(factor, Blocks(scene, 0.02)), 100 * error, 1e-9);
    EXPECT_MATRIX_NEAR(testing::Residual(factor, Blocks(scene, 0.03)),
                       100 * (error + 0.01 * velocity), 1e-9);
  });
}

TEST(PointFactor, JacobiansAreExactFarFromTheTruth) {
  testing::ForEachScene([](const FactorScene& scene) {
    const TimedBearing seen{scene.SeenInTarget(scene.p_Ch) + Vector2d(0.2, -0.1), {0.5, 0.3}, 0};
    testing::ExpectTangentJacobians(PointFactor(scene.kind, seen, 2.0), Blocks(scene, 0.05), 1e-7);
  });
}

TEST(PointFactor, RejectsPointsThatAreNotInFrontOfTheTarget) {
  FactorScene scene(1, {/*same_frame=*/false, /*same_camera=*/false});
  const PointFactor factor(scene.kind, {{0, 0}, {0, 0}, 0}, 460);
  scene.T_B_Ct = scene.T_B_Ct * Rigid3d(SO3Exp({0, M_PI, 0}), Vector3d::Zero());
  const std::vector<Block> blocks = Blocks(scene, 0);
  Vector2d residual;
  EXPECT_FALSE(factor.Evaluate(testing::Pointers(blocks).data(), residual.data(), nullptr));
}

}  // namespace
}  // namespace plm_vins

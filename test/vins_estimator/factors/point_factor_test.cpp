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

// Blocks of PointFactor.
std::vector<Block> Blocks(const FactorScene& scene, double td) {
  return testing::Joined(scene.Poses(), {ScalarBlock(td), scene.Point()});
}

TEST(PointFactor, VanishesAtTheTruth) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const FactorScene scene(seed);
    const PointFactor factor({scene.SeenInTarget(scene.p_Ch), {0.5, 0.3}, 0.02}, 460);
    EXPECT_TRUE(testing::Residual(factor, Blocks(scene, /*td=*/0.02)).isZero(1e-9));
  }
}

TEST(PointFactor, IsTheWeightedReprojectionError) {
  const FactorScene scene(1);
  const Vector2d error(0.001, -0.002), velocity(0.5, 0.3);
  const PointFactor factor({scene.SeenInTarget(scene.p_Ch) - error, velocity, 0.02}, 100);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, Blocks(scene, 0.02)), 100 * error, 1e-9);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, Blocks(scene, 0.03)),
                     100 * (error + 0.01 * velocity), 1e-9);
}

TEST(PointFactor, JacobiansAreExactFarFromTheTruth) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const FactorScene scene(seed);
    const PointFactor factor({scene.SeenInTarget(scene.p_Ch) + Vector2d(0.2, -0.1), {0.5, 0.3}, 0},
                             2.0);
    testing::ExpectTangentJacobians(factor, Blocks(scene, 0.05), 1e-7);
  }
}

TEST(PointFactor, RejectsPointsThatAreNotInFrontOfTheTarget) {
  FactorScene scene(1);
  const PointFactor factor({{0, 0}, {0, 0}, 0}, 460);
  const Rigid3d turn_around(SO3Exp({0, M_PI, 0}), Vector3d::Zero());
  scene.T_W_Bt = scene.T_W_Bt * scene.T_B_C * turn_around * scene.T_B_C.Inverse();
  const std::vector<Block> blocks = Blocks(scene, 0);
  Vector2d residual;
  EXPECT_FALSE(factor.Evaluate(testing::Pointers(blocks).data(), residual.data(), nullptr));
}

TEST(PointHostFactor, ComparesThePointWithTheHostsObservation) {
  const Vector2d xy(0.1, -0.2), velocity(1, 2);
  const PointHostFactor factor({xy, velocity, 0.01}, 100);
  const Block point = Vector3d(0.12, -0.23, 0.5);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, {ScalarBlock(0.01), point}), Vector2d(2, -3), 1e-12);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, {ScalarBlock(0.02), point}), Vector2d(3, -1), 1e-12);
  testing::ExpectTangentJacobians(factor, {ScalarBlock(0.03), point}, 1e-7);
}

}  // namespace
}  // namespace plm_vins

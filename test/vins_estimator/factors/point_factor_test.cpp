// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/point_factor.h"

#include <gtest/gtest.h>

#include "common/geometry/rigid3.h"
#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/cost_function_check.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Block;

Block Scalar(double value) { return Block::Constant(1, value); }

Block PoseBlock(const Rigid3d& T) {
  Block block(7);
  block << T.translation, T.rotation.coeffs();
  return block;
}

// Two cameras on a body at different poses, and a point that both observe.
struct Scene {
  explicit Scene(uint64_t seed) {
    simulator::Random random(seed);
    const auto rotation = [&random](double scale) {
      return SO3Exp(scale * random.NormalVector3());
    };
    T_W_Bh = {rotation(1.0), random.NormalVector3()};
    T_W_Bt = T_W_Bh * Rigid3d(rotation(0.1), 0.3 * random.NormalVector3());
    T_B_C = {rotation(0.3), 0.1 * random.NormalVector3()};
    p_Ch = Vector3d(0.5 * random.Normal(), 0.5 * random.Normal(), random.Uniform(3, 8));
    p_Ct = (T_W_Bt * T_B_C).Inverse() * (T_W_Bh * (T_B_C * p_Ch));
  }

  std::vector<Block> Blocks(double td) const {
    const Vector3d point(p_Ch.x() / p_Ch.z(), p_Ch.y() / p_Ch.z(), 1 / p_Ch.z());
    return {PoseBlock(T_W_Bh), PoseBlock(T_W_Bt), PoseBlock(T_B_C), Scalar(td), point};
  }

  Rigid3d T_W_Bh, T_W_Bt, T_B_C;
  Vector3d p_Ch, p_Ct;
};

TEST(PointFactor, VanishesAtTheTruth) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const Scene scene(seed);
    const PointFactor factor({scene.p_Ct.hnormalized(), {0.5, 0.3}, 0.02}, 460);
    EXPECT_TRUE(testing::Residual(factor, scene.Blocks(/*td=*/0.02)).isZero(1e-9));
  }
}

TEST(PointFactor, IsTheWeightedReprojectionError) {
  const Scene scene(1);
  const Vector2d error(0.001, -0.002), velocity(0.5, 0.3);
  const PointFactor factor({scene.p_Ct.hnormalized() - error, velocity, 0.02}, 100);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, scene.Blocks(0.02)), 100 * error, 1e-9);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, scene.Blocks(0.03)), 100 * (error + 0.01 * velocity),
                     1e-9);
}

TEST(PointFactor, JacobiansAreExactFarFromTheTruth) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene(seed);
    const PointFactor factor({scene.p_Ct.hnormalized() + Vector2d(0.2, -0.1), {0.5, 0.3}, 0}, 2.0);
    testing::ExpectTangentJacobians(factor, scene.Blocks(0.05), 1e-7);
  }
}

TEST(PointFactor, RejectsPointsThatAreNotInFrontOfTheTarget) {
  Scene scene(1);
  const PointFactor factor({{0, 0}, {0, 0}, 0}, 460);
  const Rigid3d turn_around(SO3Exp({0, M_PI, 0}), Vector3d::Zero());
  scene.T_W_Bt = scene.T_W_Bt * scene.T_B_C * turn_around * scene.T_B_C.Inverse();
  const std::vector<Block> blocks = scene.Blocks(0);
  Vector2d residual;
  EXPECT_FALSE(factor.Evaluate(testing::Pointers(blocks).data(), residual.data(), nullptr));
}

TEST(PointHostFactor, ComparesThePointWithTheHostsObservation) {
  const Vector2d xy(0.1, -0.2), velocity(1, 2);
  const PointHostFactor factor({xy, velocity, 0.01}, 100);
  const Block point = Vector3d(0.12, -0.23, 0.5);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, {Scalar(0.01), point}), Vector2d(2, -3), 1e-12);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, {Scalar(0.02), point}), Vector2d(3, -1), 1e-12);
  testing::ExpectTangentJacobians(factor, {Scalar(0.03), point}, 1e-7);
}

}  // namespace
}  // namespace plm_vins

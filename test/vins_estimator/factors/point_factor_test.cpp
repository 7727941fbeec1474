// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/point_factor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"
#include "test/vins_estimator/factors/factor_scene.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Block;
using testing::FactorScene;
using testing::Joined;
using testing::ScalarBlock;

std::vector<Block> Blocks(const FactorScene& scene, double td) {
  return Joined(scene.Poses(), {ScalarBlock(td), scene.Point()});
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

TEST(DepthFactor, ComparesInverseDepths) {
  const Block exact = DepthStream::Zero();
  testing::ForEachScene([&](const FactorScene& scene) {
    const double z = scene.InTarget(scene.p_Ch).z();
    const DepthFactor factor(scene.kind, {z + 0.1, /*approach=*/0.7}, 500);
    EXPECT_NEAR(testing::Residual(factor, Joined(scene.Poses(), {exact, scene.Point()}))[0],
                500 * (1 / z - 1 / (z + 0.1)), 1e-9);
  });
}

TEST(DepthFactor, JacobiansAreExactFarFromTheTruth) {
  const Block stream = (DepthStream() << 0.1, 0.08, 0.01, -0.02, 0.03).finished();
  testing::ForEachScene([&](const FactorScene& scene) {
    const double z = scene.InTarget(scene.p_Ch).z();
    testing::ExpectTangentJacobians(
        DepthFactor(scene.kind, {z + 0.1, 0.7, {0.2, -0.3}, {0.1, 0.4}, {0.5, 0.6}}, 2),
        Joined(scene.Poses(), {stream, scene.Point()}), 1e-7);
  });
}

// A point at 4 m is approached with 0.5 m/s.
TEST(TimedDepth, ExpectsScaledDepthsOfAnEarlierTime) {
  const TimedDepth measured{4, 0.5};
  const double stream[] = {std::log(1.02), 0.03, 0, 0, 0};
  EXPECT_NEAR(1 / measured.Expected(1 / 4.0, stream), 1.02 * (4 + 0.03 * 0.5), 1e-4);
}

// Inverse depth of a plane at the point that a depth image has there, which is moved and earlier.
TEST(TimedDepth, ExpectsTheInverseDepthAtAnotherPoint) {
  const Eigen::Vector2d slope(0.2, -0.1), xy(0.3, 0.4), velocity(-1, 2), shift(0.01, 0.02);
  const double delay = 0.03, zoom = 0.05;
  const double stream[] = {0, delay, shift.x(), shift.y(), zoom};
  const Eigen::Vector2d seen = xy + shift + zoom * xy + delay * velocity;
  EXPECT_NEAR(TimedDepth({4, 0, slope, xy, velocity}).Expected(0.25, stream),
              0.25 + slope.dot(seen - xy), 1e-12);
}

}  // namespace

}  // namespace plm_vins

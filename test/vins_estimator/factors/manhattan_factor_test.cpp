// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/manhattan_factor.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "test/vins_estimator/factors/factor_scene.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;
using testing::Block;

// A body with a camera that observes a line.
struct Scene {
  explicit Scene(uint64_t seed) {
    simulator::Random random(seed);
    T_W_B = {SO3Exp(random.NormalVector3()), random.NormalVector3()};
    T_B_C = {SO3Exp(0.3 * random.NormalVector3()), 0.1 * random.NormalVector3()};
    direction_W = random.NormalVector3().normalized();
    point_W = 5 * random.NormalVector3();
  }

  std::vector<Block> Blocks(double sign = 1) const {
    const Rigid3d T_W_C = T_W_B * T_B_C;
    const PluckerLine line_W = LineThrough(point_W, point_W + sign * direction_W);
    return {testing::PoseBlockOf(T_W_B), testing::PoseBlockOf(T_B_C),
            testing::LineBlockOf(T_W_C.Inverse() * line_W)};
  }

  Rigid3d T_W_B, T_B_C;
  Vector3d direction_W, point_W;
};

TEST(ManhattanFactor, VanishesOnTheAxisEitherWay) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const Scene scene(seed);
    const ManhattanFactor factor(scene.direction_W, 60);
    EXPECT_TRUE(testing::Residual(factor, scene.Blocks()).isZero(1e-9));
    EXPECT_TRUE(testing::Residual(factor, scene.Blocks(-1)).isZero(1e-9));
  }
}

TEST(ManhattanFactor, IsTheWeightedSineOfTheAngleToTheAxis) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const Scene scene(seed);
    const double angle = 0.03 * static_cast<double>(seed);
    const Vector3d axis =
        Eigen::AngleAxisd(angle, scene.direction_W.unitOrthogonal()) * scene.direction_W;
    const ManhattanFactor factor(axis, 60);
    EXPECT_NEAR(testing::Residual(factor, scene.Blocks()).norm(), 60 * std::sin(angle), 1e-9);
    EXPECT_NEAR(testing::Residual(factor, scene.Blocks(-1)).norm(), 60 * std::sin(angle), 1e-9);
  }
}

TEST(ManhattanFactor, DoesNotDependOnPositions) {
  Scene scene(1);
  const ManhattanFactor factor(Vector3d::UnitX(), 60);
  const Eigen::VectorXd residual = testing::Residual(factor, scene.Blocks());
  scene.T_W_B.translation += Vector3d(1, 2, 3);
  scene.point_W += Vector3d(-3, 1, 2);
  EXPECT_MATRIX_NEAR(testing::Residual(factor, scene.Blocks()), residual, 1e-9);
}

TEST(ManhattanFactor, ObservesHeadingFromHorizontalLinesOnly) {
  Scene scene(2);
  const auto turned = [&scene](const Vector3d& axis) {
    scene.direction_W = axis;
    const std::vector<Block> blocks = scene.Blocks();
    Scene other = scene;
    other.T_W_B.rotation = SO3Exp({0, 0, 0.02}) * scene.T_W_B.rotation;
    std::vector<Block> moved = other.Blocks();
    moved[2] = blocks[2];  // the line in the camera frame
    return testing::Residual(ManhattanFactor(axis, 1), moved).norm();
  };
  EXPECT_NEAR(turned(Vector3d::UnitX()), std::sin(0.02), 1e-9);
  EXPECT_NEAR(turned(Vector3d::UnitZ()), 0, 1e-9);
}

TEST(ManhattanFactor, JacobiansAreExact) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene(seed);
    for (int axis = 0; axis < 3; ++axis) {
      const ManhattanFactor factor(Vector3d::Unit(axis), 3);
      testing::ExpectTangentJacobians(factor, scene.Blocks(), 1e-7);
    }
  }
}

}  // namespace
}  // namespace plm_vins

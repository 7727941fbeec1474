// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/line_factor.h"

#include <gtest/gtest.h>

#include "test/vins_estimator/factors/factor_scene.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Block;
using testing::FactorScene;

// The target's observation of the line's endpoints.
LineSegmentView View(const FactorScene& scene) {
  return {scene.SeenInTarget(scene.p_Ch), scene.SeenInTarget(scene.q_Ch)};
}

// Blocks of LineFactor.
std::vector<Block> Blocks(const FactorScene& scene) {
  return testing::Joined(scene.Poses(), {scene.Line()});
}

// Unit normal of an observation in the image.
Vector2d Across(const LineSegmentView& view) {
  const Vector2d along = (view.end - view.start).normalized();
  return {-along.y(), along.x()};
}

bool Evaluates(const Factor& cost, const std::vector<Block>& blocks) {
  Vector2d residual;
  return cost.Evaluate(testing::Pointers(blocks).data(), residual.data(), nullptr);
}

TEST(LineFactor, VanishesAtTheTruth) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const FactorScene scene(seed);
    const LineFactor factor(View(scene), 460);
    EXPECT_TRUE(testing::Residual(factor, Blocks(scene)).isZero(1e-9));
  }
}

TEST(LineFactor, IsTheWeightedDistanceAcrossTheLineOnly) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const FactorScene scene(seed);
    const LineSegmentView truth = View(scene);
    const Vector2d along = truth.end - truth.start, across = Across(truth);
    const LineSegmentView view{truth.start + 0.3 * along + 0.002 * across,
                               truth.end - 0.1 * along - 0.001 * across};
    const Eigen::VectorXd residual = testing::Residual(LineFactor(view, 100), Blocks(scene));
    const double sign = residual[0] > 0 ? 1 : -1;  // sign of the moment
    EXPECT_MATRIX_NEAR(sign * residual, Vector2d(0.2, -0.1), 1e-9);
  }
}

TEST(LineFactor, IgnoresMotionAlongTheLine) {
  FactorScene scene(1);
  const LineFactor factor(View(scene), 460);
  const Vector3d direction_Ch = (scene.q_Ch - scene.p_Ch).normalized();
  const Vector3d direction_W = (scene.T_W_Bh * scene.T_B_C).rotation * direction_Ch;
  scene.T_W_Bt.translation += 0.2 * direction_W;
  EXPECT_TRUE(testing::Residual(factor, Blocks(scene)).isZero(1e-9));
  scene.T_W_Bt.translation += 0.2 * direction_W.unitOrthogonal();
  EXPECT_GT(testing::Residual(factor, Blocks(scene)).norm(), 1);
}

TEST(LineFactor, JacobiansAreExactFarFromTheTruth) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const FactorScene scene(seed);
    LineSegmentView view = View(scene);
    view.start += Vector2d(0.1, -0.05);
    view.end += Vector2d(-0.05, 0.2);
    testing::ExpectTangentJacobians(LineFactor(view, 3), Blocks(scene), 1e-5);
  }
}

TEST(LineFactor, FailsWhereTheLinePassesThroughTheTarget) {
  FactorScene scene(2);
  const LineFactor factor(View(scene), 460);
  const Rigid3d T_W_Ch = scene.T_W_Bh * scene.T_B_C;
  const Vector3d on_the_line_W = T_W_Ch * Vector3d(0.5 * (scene.p_Ch + scene.q_Ch));
  const Vector3d p_W_Ct = (scene.T_W_Bt * scene.T_B_C).translation;
  scene.T_W_Bt.translation += on_the_line_W - p_W_Ct;
  EXPECT_FALSE(Evaluates(factor, Blocks(scene)));
}

TEST(LineHostFactor, ComparesTheLineWithTheHostsObservation) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const FactorScene scene(seed);
    const std::vector<Block> blocks = {scene.Line()};
    const LineSegmentView truth{scene.p_Ch.hnormalized(), scene.q_Ch.hnormalized()};
    EXPECT_TRUE(testing::Residual(LineHostFactor(truth, 460), blocks).isZero(1e-9));
    const Vector2d across = Across(truth);
    const LineSegmentView view{truth.start + 0.002 * across, truth.end + 0.001 * across};
    const Eigen::VectorXd residual = testing::Residual(LineHostFactor(view, 100), blocks);
    EXPECT_MATRIX_NEAR(residual.cwiseAbs(), Vector2d(0.2, 0.1), 1e-9);
    testing::ExpectTangentJacobians(LineHostFactor(view, 3), blocks, 1e-6);
  }
}

// If the target is at the host's pose with the host's observation, the residuals are equal.
TEST(LineHostFactor, IsALineFactorWithoutMotion) {
  FactorScene scene(3);
  scene.T_W_Bt = scene.T_W_Bh;
  const LineSegmentView view{{0.1, 0.2}, {-0.3, 0.1}};
  const std::vector<Block> blocks = Blocks(scene);
  EXPECT_MATRIX_NEAR(testing::Residual(LineHostFactor(view, 460), {blocks.back()}),
                     testing::Residual(LineFactor(view, 460), blocks), 1e-9);
}

TEST(LineHostFactor, FailsOnTheLineAtInfinity) {
  // Its moment is along the line of sight, so its image is far away.
  const PluckerLine line{Vector3d(0, 0, 1), Vector3d(1e-3, 0, 0)};
  EXPECT_FALSE(Evaluates(LineHostFactor({{0, 0}, {1, 0}}, 460), {testing::LineBlockOf(line)}));
}

}  // namespace
}  // namespace plm_vins

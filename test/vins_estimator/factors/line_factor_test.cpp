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
SegmentEndPoints View(const FactorScene& scene) {
  return {scene.SeenInTarget(scene.p_Ch), scene.SeenInTarget(scene.q_Ch)};
}

std::vector<Block> Blocks(const FactorScene& scene) {
  return testing::Joined(scene.Poses(), {scene.Line()});
}

bool Evaluates(const Factor& cost, const std::vector<Block>& blocks) {
  Vector2d residual;
  return cost.Evaluate(testing::Pointers(blocks).data(), residual.data(), nullptr);
}

TEST(LineFactor, IsTheWeightedDistanceAcrossTheLineOnly) {
  testing::ForEachScene([](const FactorScene& scene) {
    const SegmentEndPoints truth = View(scene);
    const Vector2d along = truth.end - truth.start;
    const Vector2d across = Vector2d(-along.y(), along.x()).normalized();
    const SegmentEndPoints view{truth.start + 0.3 * along + 0.002 * across,
                                truth.end - 0.1 * along - 0.001 * across};
    const LineFactor factor(scene.kind, view, {100, 300});
    ASSERT_EQ(static_cast<size_t>(factor.num_blocks()), Blocks(scene).size());
    const Eigen::VectorXd residual = testing::Residual(factor, Blocks(scene));
    const double sign = residual[0] > 0 ? 1 : -1;  // sign of the moment
    EXPECT_MATRIX_NEAR(sign * residual, Vector2d(0.2, -0.3), 1e-9);
  });
}

TEST(LineFactor, IgnoresMotionAlongTheLine) {
  FactorScene scene(1);
  const LineFactor factor(scene.kind, View(scene), {460, 460});
  const Vector3d direction_Ch = (scene.q_Ch - scene.p_Ch).normalized();
  const Vector3d direction_W = (scene.T_W_Bh * scene.T_B_Ch).rotation * direction_Ch;
  scene.T_W_Bt.translation += 0.2 * direction_W;
  EXPECT_TRUE(testing::Residual(factor, Blocks(scene)).isZero(1e-9));
  scene.T_W_Bt.translation += 0.2 * direction_W.unitOrthogonal();
  EXPECT_GT(testing::Residual(factor, Blocks(scene)).norm(), 1);
}

TEST(LineFactor, JacobiansAreExactFarFromTheTruth) {
  testing::ForEachScene([](const FactorScene& scene) {
    SegmentEndPoints view = View(scene);
    view.start += Vector2d(0.1, -0.05);
    view.end += Vector2d(-0.05, 0.2);
    testing::ExpectTangentJacobians(LineFactor(scene.kind, view, {2, 3}), Blocks(scene), 1e-5);
  });
}

TEST(LineFactor, FailsWhereTheLinePassesThroughTheTarget) {
  FactorScene scene(2);
  const LineFactor factor(scene.kind, View(scene), {460, 460});
  const Rigid3d T_W_Ch = scene.T_W_Bh * scene.T_B_Ch;
  const Vector3d on_the_line_W = T_W_Ch * Vector3d(0.5 * (scene.p_Ch + scene.q_Ch));
  const Vector3d p_W_Ct = (scene.T_W_Bt * scene.T_B_Ct).translation;
  scene.T_W_Bt.translation += on_the_line_W - p_W_Ct;
  EXPECT_FALSE(Evaluates(factor, Blocks(scene)));
}

TEST(LineFactor, FailsOnTheLineAtInfinity) {
  // Its moment is along the line of sight, so its image is far away.
  const PluckerLine line{Vector3d(0, 0, 1), Vector3d(1e-3, 0, 0)};
  const LineFactor in_host({/*same_frame=*/true, /*same_camera=*/true}, {{0, 0}, {1, 0}},
                           {460, 460});
  EXPECT_FALSE(Evaluates(in_host, {testing::LineBlockOf(line)}));
}

}  // namespace
}  // namespace plm_vins

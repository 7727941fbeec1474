// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/line_factor.h"

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

Block PoseBlockOf(const Rigid3d& T) {
  Block block(kPoseSize);
  block << T.translation, T.rotation.coeffs();
  return block;
}

Block LineBlock(const PluckerLine& line) {
  const OrthonormalLine coordinates = ToOrthonormal(line);
  return Eigen::Map<const Eigen::Matrix<double, kLineSize, 1>>(coordinates.data());
}

// Two cameras on a body at different poses, and a line that both observe.
struct Scene {
  explicit Scene(uint64_t seed) {
    simulator::Random random(seed);
    const auto rotation = [&random](double scale) {
      return SO3Exp(scale * random.NormalVector3());
    };
    const auto point = [&random]() {
      const double x = random.Normal(), y = random.Normal();
      return Vector3d(x, y, random.Uniform(3, 8));
    };
    T_W_Bh = {rotation(1.0), random.NormalVector3()};
    T_W_Bt = T_W_Bh * Rigid3d(rotation(0.1), 0.3 * random.NormalVector3());
    T_B_C = {rotation(0.3), 0.1 * random.NormalVector3()};
    start_Ch = point();
    end_Ch = point();
  }

  Rigid3d T_Ct_Ch() const { return (T_W_Bt * T_B_C).Inverse() * T_W_Bh * T_B_C; }

  // The target's observation of the line's endpoints.
  LineSegmentView View() const {
    return {(T_Ct_Ch() * start_Ch).hnormalized(), (T_Ct_Ch() * end_Ch).hnormalized()};
  }

  std::vector<Block> Blocks() const {
    return {PoseBlockOf(T_W_Bh), PoseBlockOf(T_W_Bt), PoseBlockOf(T_B_C),
            LineBlock(LineThrough(start_Ch, end_Ch))};
  }

  Rigid3d T_W_Bh, T_W_Bt, T_B_C;
  Vector3d start_Ch, end_Ch;
};

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
    const Scene scene(seed);
    const LineFactor factor(scene.View(), 460);
    EXPECT_TRUE(testing::Residual(factor, scene.Blocks()).isZero(1e-9));
  }
}

TEST(LineFactor, IsTheWeightedDistanceAcrossTheLineOnly) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const Scene scene(seed);
    const LineSegmentView truth = scene.View();
    const Vector2d along = truth.end - truth.start, across = Across(truth);
    const LineSegmentView view{truth.start + 0.3 * along + 0.002 * across,
                               truth.end - 0.1 * along - 0.001 * across};
    const Eigen::VectorXd residual = testing::Residual(LineFactor(view, 100), scene.Blocks());
    const double sign = residual[0] > 0 ? 1 : -1;  // sign of the moment
    EXPECT_MATRIX_NEAR(sign * residual, Vector2d(0.2, -0.1), 1e-9);
  }
}

TEST(LineFactor, IgnoresMotionAlongTheLine) {
  Scene scene(1);
  const LineFactor factor(scene.View(), 460);
  const Vector3d direction_Ch = (scene.end_Ch - scene.start_Ch).normalized();
  const Vector3d direction_W = (scene.T_W_Bh * scene.T_B_C).rotation * direction_Ch;
  scene.T_W_Bt.translation += 0.2 * direction_W;
  EXPECT_TRUE(testing::Residual(factor, scene.Blocks()).isZero(1e-9));
  scene.T_W_Bt.translation += 0.2 * direction_W.unitOrthogonal();
  EXPECT_GT(testing::Residual(factor, scene.Blocks()).norm(), 1);
}

TEST(LineFactor, JacobiansAreExactFarFromTheTruth) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene(seed);
    LineSegmentView view = scene.View();
    view.start += Vector2d(0.1, -0.05);
    view.end += Vector2d(-0.05, 0.2);
    testing::ExpectTangentJacobians(LineFactor(view, 3), scene.Blocks(), 1e-5);
  }
}

TEST(LineFactor, FailsWhereTheLinePassesThroughTheTarget) {
  Scene scene(2);
  const LineFactor factor(scene.View(), 460);
  const Rigid3d T_W_Ch = scene.T_W_Bh * scene.T_B_C;
  const Vector3d on_the_line_W = T_W_Ch * Vector3d(0.5 * (scene.start_Ch + scene.end_Ch));
  const Vector3d p_W_Ct = (scene.T_W_Bt * scene.T_B_C).translation;
  scene.T_W_Bt.translation += on_the_line_W - p_W_Ct;
  EXPECT_FALSE(Evaluates(factor, scene.Blocks()));
}

TEST(LineHostFactor, ComparesTheLineWithTheHostsObservation) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const Scene scene(seed);
    const std::vector<Block> blocks = {scene.Blocks().back()};
    const LineSegmentView truth{scene.start_Ch.hnormalized(), scene.end_Ch.hnormalized()};
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
  Scene scene(3);
  scene.T_W_Bt = scene.T_W_Bh;
  const LineSegmentView view{{0.1, 0.2}, {-0.3, 0.1}};
  const std::vector<Block> blocks = scene.Blocks();
  EXPECT_MATRIX_NEAR(testing::Residual(LineHostFactor(view, 460), {blocks.back()}),
                     testing::Residual(LineFactor(view, 460), blocks), 1e-9);
}

TEST(LineHostFactor, FailsOnTheLineAtInfinity) {
  // Its moment is along the line of sight, so its image is far away.
  const PluckerLine line{Vector3d(0, 0, 1), Vector3d(1e-3, 0, 0)};
  EXPECT_FALSE(Evaluates(LineHostFactor({{0, 0}, {1, 0}}, 460), {LineBlock(line)}));
}

}  // namespace
}  // namespace plm_vins

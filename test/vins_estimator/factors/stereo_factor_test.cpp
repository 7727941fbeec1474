// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/stereo_factor.h"

#include <gtest/gtest.h>

#include "simulator/random.h"
#include "test/vins_estimator/factors/factor_scene.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using testing::Block;
using testing::FactorScene;
using testing::Joined;
using testing::ScalarBlock;

constexpr double kStep = 1e-6;

TEST(Mounting, PlusTurnsAndStretchesTheBaselineAndMinusInvertsIt) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    simulator::Random random(seed);
    const Block x = FactorScene(seed).Mounting();
    Eigen::VectorXd delta(kPoseTangentSize);
    for (double& value : delta) value = random.Uniform(-0.5, 0.5);
    Block y = x;
    MountingPlus(x.data(), delta.data(), y.data());
    EXPECT_NEAR(y.head<3>().norm(), std::exp(delta[2]) * x.head<3>().norm(), 1e-15);
    Eigen::VectorXd difference(kPoseTangentSize);
    MountingMinus(y.data(), x.data(), difference.data());
    EXPECT_MATRIX_NEAR(difference, delta, 1e-12);
  }
}

TEST(RightPointFactor, IsTheWeightedReprojectionErrorInTheSecondCamera) {
  const Vector2d error(0.001, -0.002), velocity(0.5, 0.3);
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const FactorScene s(seed);
    const Block point = s.Point(), mounting = s.Mounting();
    const RightPointFactor target(
        {s.SeenInRight(s.InTarget(s.p_Ch)) - error, velocity, /*cut_time_offset=*/0.02}, 100);
    const std::vector<Block> blocks = Joined(s.Poses(), {mounting, ScalarBlock(0.03), point});
    EXPECT_MATRIX_NEAR(testing::Residual(target, blocks), 100 * (error + 0.01 * velocity), 1e-9);
    const RightPointHostFactor host({s.SeenInRight(s.p_Ch) - error, velocity, 0.02}, 100);
    EXPECT_MATRIX_NEAR(testing::Residual(host, {mounting, ScalarBlock(0.03), point}),
                       100 * (error + 0.01 * velocity), 1e-9);
  }
}

TEST(RightPointFactor, JacobiansAreExactFarFromTheTruth) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const FactorScene s(seed);
    const TimedBearing bearing{Vector2d(0.2, -0.1), {0.5, 0.3}, 0};
    const Block point = s.Point(), mounting = s.Mounting(), td = ScalarBlock(0.05);
    testing::ExpectTangentJacobians(RightPointFactor(bearing, 2.0),
                                    Joined(s.Poses(), {mounting, td, point}), 1e-7, kStep,
                                    /*mounting=*/3);
    testing::ExpectTangentJacobians(RightPointHostFactor(bearing, 2.0), {mounting, td, point}, 1e-7,
                                    kStep, /*mounting=*/0);
  }
}

TEST(RightPointFactor, RejectsPointsThatAreNotInFrontOfTheSecondCamera) {
  FactorScene s(1);
  s.T_C_C1.rotation = SO3Exp({0, M_PI, 0});
  const RightPointHostFactor factor({{0, 0}, {0, 0}, 0}, 460);
  const std::vector<Block> blocks = {s.Mounting(), ScalarBlock(0), s.Point()};
  Vector2d residual;
  EXPECT_FALSE(factor.Evaluate(testing::Pointers(blocks).data(), residual.data(), nullptr));
}

TEST(RightLineFactor, VanishesAtTheTruthAndWeighsBothEnds) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const FactorScene s(seed);
    const Block line = s.Line(), mounting = s.Mounting();
    const LineSegmentView truth{s.SeenInRight(s.InTarget(s.p_Ch)),
                                s.SeenInRight(s.InTarget(s.q_Ch))};
    const std::vector<Block> blocks = Joined(s.Poses(), {mounting, line});
    EXPECT_TRUE(testing::Residual(RightLineFactor(truth, {460, 460}), blocks).isZero(1e-9));
    const Vector2d along = (truth.end - truth.start).normalized(), across(-along.y(), along.x());
    const LineSegmentView view{truth.start + 0.001 * across, truth.end + 0.001 * across};
    const Eigen::VectorXd residual = testing::Residual(RightLineFactor(view, {100, 300}), blocks);
    EXPECT_MATRIX_NEAR(residual.cwiseAbs(), Vector2d(0.1, 0.3), 1e-9);
    const LineSegmentView in_host{s.SeenInRight(s.p_Ch), s.SeenInRight(s.q_Ch)};
    EXPECT_TRUE(
        testing::Residual(RightLineHostFactor(in_host, {460, 460}), {mounting, line}).isZero(1e-9));
  }
}

TEST(RightLineFactor, JacobiansAreExactFarFromTheTruth) {
  const LineSegmentView view{{0.2, -0.1}, {-0.3, 0.2}};
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const FactorScene s(seed);
    const Block line = s.Line(), mounting = s.Mounting();
    testing::ExpectTangentJacobians(RightLineFactor(view, {2, 3}),
                                    Joined(s.Poses(), {mounting, line}), 1e-6, kStep,
                                    /*mounting=*/3);
    testing::ExpectTangentJacobians(RightLineHostFactor(view, {2, 3}), {mounting, line}, 1e-6,
                                    kStep, /*mounting=*/0);
  }
}

TEST(DepthFactor, ComparesInverseDepths) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const FactorScene s(seed);
    const Block point = s.Point();
    const Block exact = Eigen::Vector2d::Zero();
    const double z = s.InTarget(s.p_Ch).z(), z_host = s.p_Ch.z();
    const DepthFactor target({z + 0.1, /*approach=*/0.7}, 500);
    EXPECT_NEAR(testing::Residual(target, Joined(s.Poses(), {exact, point}))[0],
                500 * (1 / z - 1 / (z + 0.1)), 1e-9);
    const DepthHostFactor host({z_host - 0.1, 0.7}, 2);
    EXPECT_NEAR(testing::Residual(host, {exact, point})[0], 2 / z_host - 2 / (z_host - 0.1), 1e-9);
  }
}

TEST(DepthFactor, JacobiansAreExactFarFromTheTruth) {
  const Block stream = Vector2d(0.1, 0.08);
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const FactorScene s(seed);
    const double z = s.InTarget(s.p_Ch).z();
    testing::ExpectTangentJacobians(DepthFactor({z + 0.1, 0.7}, 2),
                                    Joined(s.Poses(), {stream, s.Point()}), 1e-7);
    testing::ExpectTangentJacobians(DepthHostFactor({s.p_Ch.z(), 0.7}, 2), {stream, s.Point()},
                                    1e-7);
  }
}

// A point at 4 m is approached with 0.5 m/s.
TEST(TimedDepth, ExpectsScaledDepthsOfAnEarlierTime) {
  const TimedDepth measured{4, 0.5};
  const double stream[] = {std::log(1.02), 0.03};
  EXPECT_NEAR(1 / measured.Expected(1 / 4.0, stream), 1.02 * (4 + 0.03 * 0.5), 1e-4);
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/depth_factor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/vins_estimator/factors/factor_scene.h"

namespace plm_vins {
namespace {

using testing::Block;
using testing::FactorScene;
using testing::Joined;

TEST(DepthFactor, ComparesInverseDepths) {
  const Block exact = Eigen::Vector2d::Zero();
  testing::ForEachScene([&](const FactorScene& scene) {
    const double z = scene.InTarget(scene.p_Ch).z();
    const DepthFactor factor(scene.kind, {z + 0.1, /*approach=*/0.7}, 500);
    EXPECT_NEAR(testing::Residual(factor, Joined(scene.Poses(), {exact, scene.Point()}))[0],
                500 * (1 / z - 1 / (z + 0.1)), 1e-9);
  });
}

TEST(DepthFactor, JacobiansAreExactFarFromTheTruth) {
  const Block stream = Eigen::Vector2d(0.1, 0.08);
  testing::ForEachScene([&](const FactorScene& scene) {
    const double z = scene.InTarget(scene.p_Ch).z();
    testing::ExpectTangentJacobians(DepthFactor(scene.kind, {z + 0.1, 0.7}, 2),
                                    Joined(scene.Poses(), {stream, scene.Point()}), 1e-7);
  });
}

// A point at 4 m is approached with 0.5 m/s.
TEST(TimedDepth, ExpectsScaledDepthsOfAnEarlierTime) {
  const TimedDepth measured{4, 0.5};
  const double stream[] = {std::log(1.02), 0.03};
  EXPECT_NEAR(1 / measured.Expected(1 / 4.0, stream), 1.02 * (4 + 0.03 * 0.5), 1e-4);
}

}  // namespace
}  // namespace plm_vins

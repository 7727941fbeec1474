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

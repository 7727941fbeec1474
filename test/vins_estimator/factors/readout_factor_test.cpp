// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/readout_factor.h"

#include <gtest/gtest.h>

#include "test/testing/cost_function_check.h"
#include "vins_estimator/factors/point_factor.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Block;

Block Scalar(double value) { return Block::Constant(1, value); }

TimedBearing Bearing() {
  TimedBearing bearing{{0.1, -0.2}, {1, 2}, 0.01};
  bearing.share = 0.4;
  bearing.cut_readout = 0.02;
  return bearing;
}

// Blocks: td, point, readout time.
ReadoutFactor<PointHostFactor> HostFactor() { return {PointHostFactor(Bearing(), 100), Bearing()}; }

TEST(ReadoutFactor, IsTheFactorAtTheTimeOfTheRow) {
  const PointHostFactor plain(Bearing(), 100);
  const Block point = Vector3d(0.12, -0.23, 0.5);
  EXPECT_MATRIX_NEAR(testing::Residual(HostFactor(), {Scalar(0.015), point, Scalar(0.02)}),
                     testing::Residual(plain, {Scalar(0.015), point}), 1e-12);
  EXPECT_MATRIX_NEAR(testing::Residual(HostFactor(), {Scalar(0.015), point, Scalar(0.03)}),
                     testing::Residual(plain, {Scalar(0.019), point}), 1e-12);
}

TEST(ReadoutFactor, HasExactJacobians) {
  const Block point = Vector3d(0.12, -0.23, 0.5);
  testing::ExpectTangentJacobians(HostFactor(), {Scalar(0.03), point, Scalar(0.05)}, 1e-7);
  Block turned(7);
  turned << 0.3, -0.1, 0.2, 0.05, -0.02, 0.03, 1;
  turned.tail<4>().normalize();
  Block identity = Block::Zero(7);
  identity[6] = 1;
  const ReadoutFactor<PointFactor> factor(PointFactor(Bearing(), 2.0), Bearing());
  testing::ExpectTangentJacobians(
      factor, {identity, turned, identity, Scalar(0.05), point, Scalar(0.04)}, 1e-7);
}

TEST(ReadoutFactor, DoesNotNeedTheTimeOffsetToBeEstimated) {
  const std::vector<Block> blocks = {Scalar(0.03), Vector3d(0.12, -0.23, 0.5), Scalar(0.05)};
  Vector2d residual, d_readout;
  double* jacobians[] = {nullptr, nullptr, d_readout.data()};
  ASSERT_TRUE(HostFactor().Evaluate(testing::Pointers(blocks).data(), residual.data(), jacobians));
  EXPECT_MATRIX_NEAR(d_readout, 100 * 0.4 * Vector2d(1, 2), 1e-9);
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/robust_weight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins {
namespace {

TEST(GemanMcClureWeight, FallsFromOneToZero) {
  EXPECT_EQ(GemanMcClureWeight(0, 2), 1);
  EXPECT_EQ(GemanMcClureWeight(2, 2), 0.25);
  EXPECT_EQ(GemanMcClureWeight(-2, 2), 0.25);
  EXPECT_LT(GemanMcClureWeight(20, 2), 1e-4);
}

// The loss rho(e) = 0.5 e^2 / (1 + e^2 / s^2) has rho'(e) = weight * e.
TEST(GemanMcClureWeight, IsTheDerivativeOfItsLoss) {
  const double scale = 1.7, error = 0.8, step = 1e-6;
  const auto loss = [scale](double e) { return 0.5 * e * e / (1 + e * e / (scale * scale)); };
  const double slope = (loss(error + step) - loss(error - step)) / (2 * step);
  EXPECT_NEAR(GemanMcClureWeight(error, scale), slope / error, 1e-8);
}

}  // namespace
}  // namespace plm_vins

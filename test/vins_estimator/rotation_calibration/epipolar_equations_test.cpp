// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/epipolar_equations.h"

#include <gtest/gtest.h>

#include "test/vins_estimator/rotation_calibration/simulated_pairs.h"

namespace plm_vins {
namespace {

using testing::kR_B_C;
using Vector = CalibrationError::Vector;

constexpr double kNoise = 1e-3;

Vector SomeError() {
  Vector x = Vector::Constant(0.02);
  x[CalibrationError::kDelay] = -0.01;
  x[CalibrationError::kFocal] = 0.1;
  x[CalibrationError::kDistortion] = -0.1;
  x.segment<3>(CalibrationError::kExtrinsics) << 0.1, -0.05, 0.03;
  return x;
}

TEST(EpipolarEquations, CostNothingAtTheTruth) {
  const auto equations =
      LinearizeEpipolar(testing::SimulatePairs(SomeError()), kR_B_C, kNoise, SomeError());
  EXPECT_NEAR(equations.cost, 0, 1e-9);
  EXPECT_NEAR(equations.g.norm(), 0, 1e-6);
  EXPECT_EQ(equations.points, 60 * 30);
}

// The translation follows each error, so that the whole Hessian is tested.
TEST(EpipolarEquations, CostIsQuadraticAboutTheTruth) {
  const Vector truth = SomeError();
  const auto pairs = testing::SimulatePairs(truth);
  const auto H = LinearizeEpipolar(pairs, kR_B_C, kNoise, truth).H;
  simulator::Random random(4);
  for (int k = 0; k < CalibrationError::kSize + 20; ++k) {
    Vector direction = Vector::Zero();
    if (k < CalibrationError::kSize) {
      direction[k] = 1;
    } else {
      for (int i = 0; i < direction.size(); ++i) direction[i] = random.Normal();
    }
    const double curvature = direction.dot(H * direction);
    const Vector step = direction * std::sqrt(0.02 / curvature);
    const double forward = LinearizeEpipolar(pairs, kR_B_C, kNoise, truth + step).cost;
    const double backward = LinearizeEpipolar(pairs, kR_B_C, kNoise, truth - step).cost;
    EXPECT_NEAR(0.5 * (forward + backward), 0.01, 1e-4) << k;
    // So is the gradient.
    const Vector g = LinearizeEpipolar(pairs, kR_B_C, kNoise, truth + step).g;
    EXPECT_NEAR(g.dot(step), 0.02, 4e-4) << k;
  }
}

TEST(EpipolarEquations, NeedNoTranslation) {
  testing::PairOptions options;
  options.translation = 0;
  Vector wrong = Vector::Zero();
  const auto pairs = testing::SimulatePairs(wrong, options);
  EXPECT_NEAR(LinearizeEpipolar(pairs, kR_B_C, kNoise, wrong).cost, 0, 1e-9);
  wrong[CalibrationError::kFocal] = 0.1;
  EXPECT_GT(LinearizeEpipolar(pairs, kR_B_C, kNoise, wrong).cost, 100);
}

}  // namespace
}  // namespace plm_vins

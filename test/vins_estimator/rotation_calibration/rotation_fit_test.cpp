// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/rotation_fit.h"

#include <gtest/gtest.h>

#include "test/vins_estimator/rotation_calibration/simulated_pairs.h"

namespace plm_vins {
namespace {

using Cause = RotationFit::Cause;
using Error = CalibrationError;

constexpr double kRayNoise = 5e-4;

// Pairs with noise, a bias of the gyroscope, and one wrong track in twenty.
RotationFit Explain(Error::Vector x, testing::PairOptions options = {}) {
  options.noise = kRayNoise;
  options.outliers_every = 20;
  x.segment<3>(Error::kBias) << 0.003, -0.006, 0.009;
  return ExplainRotations(testing::SimulatePairs(x, options), testing::kR_B_C, kRayNoise);
}

Error::Vector One(int element, double value) {
  Error::Vector x = Error::Vector::Zero();
  x[element] = value;
  return x;
}

TEST(RotationFit, FindsNothingIfAllIsRight) {
  EXPECT_EQ(Explain(Error::Vector::Zero()).cause, Cause::kNone);
}

TEST(RotationFit, FindsASingleError) {
  struct Case {
    int element;
    Cause cause;
    double factor;  // of the amount
  };
  constexpr double kLargestSquaredRadius = 1;
  for (const auto& [element, cause, factor] :
       {Case{Error::kDelay, Cause::kTimeOffset, 0.5}, Case{Error::kFocal, Cause::kFocalLength, 1},
        Case{Error::kDistortion, Cause::kDistortion, kLargestSquaredRadius}}) {
    for (const double value : {-0.06, 0.05}) {
      const RotationFit fit = Explain(One(element, factor * value));
      EXPECT_EQ(fit.cause, cause) << element << ' ' << value;
      EXPECT_NEAR(fit.amount, factor * value, 0.2 * std::abs(value)) << element << ' ' << value;
    }
  }
}

TEST(RotationFit, FindsThePrincipalPoint) {
  Error::Vector x = Error::Vector::Zero();
  x.segment<2>(Error::kPrincipal) << -0.03, 0.04;
  const RotationFit fit = Explain(x);
  EXPECT_EQ(fit.cause, Cause::kPrincipalPoint);
  EXPECT_NEAR(fit.amount, 0.05, 0.005);
}

TEST(RotationFit, FindsTheFocalLengthOfAnotherResolution) {
  for (const double focal : {-0.5, 0.4, 1.0}) {
    const RotationFit fit = Explain(One(Error::kFocal, focal));
    EXPECT_EQ(fit.cause, Cause::kFocalLength) << focal;
    EXPECT_NEAR(fit.amount, focal, 0.05) << focal;
  }
}

TEST(RotationFit, FindsAWrongMounting) {
  for (const double factor : {1, 4}) {
    Error::Vector x = Error::Vector::Zero();
    x.segment<3>(Error::kExtrinsics) << 0.03 * factor, -0.04 * factor, 0;
    const RotationFit fit = Explain(x);
    EXPECT_EQ(fit.cause, Cause::kExtrinsics) << factor;
    EXPECT_NEAR(fit.amount, 0.05 * factor, 0.005 * factor) << factor;
  }
}

TEST(RotationFit, FindsScaleAndAxesOfTheGyro) {
  Error::Vector x = Error::Vector::Zero();
  x.tail<9>() << 0.05, 0.02, 0, 0, -0.03, 0, 0, 0, 0;
  const RotationFit fit = Explain(x);
  EXPECT_EQ(fit.cause, Cause::kGyro);
  EXPECT_NEAR(fit.amount, 0.055, 0.01);
}

TEST(RotationFit, FindsOneScaleOfTheGyro) {
  Error::Vector x = Error::Vector::Zero();
  x[Error::kGyro] = x[Error::kGyro + 4] = x[Error::kGyro + 8] = -0.05;
  const RotationFit fit = Explain(x);
  EXPECT_EQ(fit.cause, Cause::kGyro);
  EXPECT_NEAR(fit.amount, 0.05, 0.005);
}

// Few points may fit an error by chance.
TEST(RotationFit, NeedsStrongEvidence) {
  Error::Vector x = Error::Vector::Zero();
  x[Error::kGyro] = x[Error::kGyro + 4] = x[Error::kGyro + 8] = 0.025;
  testing::PairOptions options;
  options.turn = 0.03;
  EXPECT_EQ(Explain(x, options).cause, Cause::kGyro);
  options.count = 30;
  options.points = 8;
  EXPECT_EQ(Explain(x, options).cause, Cause::kNone);
}

TEST(RotationFit, IsUnknownWithFewOrSmallRotations) {
  testing::PairOptions few, small;
  few.count = 15;
  small.turn = 0.01;
  EXPECT_EQ(Explain(Error::Vector::Zero(), few).cause, Cause::kUnknown);
  EXPECT_EQ(Explain(Error::Vector::Zero(), small).cause, Cause::kUnknown);
}

// This is the case with moving objects, or if the rotation is grossly wrong.
TEST(RotationFit, IsUnknownIfNoErrorExplainsThePoints) {
  auto pairs = testing::SimulatePairs(Error::Vector::Zero());
  for (RotationPair& pair : pairs) pair.R_B0_B1 = pair.R_B0_B1.conjugate();
  EXPECT_EQ(ExplainRotations(pairs, testing::kR_B_C, kRayNoise).cause, Cause::kUnknown);
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/lengths/ratio_curve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins {
namespace {

RatioCurve Gaussian(double mean, double deviation) {
  RatioCurve curve;
  for (int i = 0; i < RatioCurve::kPoints; ++i) {
    const double half_square = 0.5 * std::pow((RatioCurve::LogRatio(i) - mean) / deviation, 2);
    curve.Set(i, -half_square, half_square);
  }
  return curve;
}

TEST(RatioCurve, GivesMeanAndDeviation) {
  const RatioEstimate estimate = Gaussian(0.3217, 0.04).Estimate(0.03);
  EXPECT_NEAR(estimate.log_ratio, 0.3217, 1e-6);
  EXPECT_NEAR(estimate.deviation, 0.05, 1e-6);
  EXPECT_NEAR(estimate.contradiction, 0.3217 / 0.05, 1e-4);
}

TEST(RatioCurve, IndependentCurvesAddUp) {
  RatioCurve sum = Gaussian(0.1, 0.02);
  sum.Add(Gaussian(0.2, 0.02));
  const RatioEstimate estimate = sum.Estimate(0);
  EXPECT_NEAR(estimate.log_ratio, 0.15, 1e-6);
  EXPECT_NEAR(estimate.deviation, 0.02 / std::sqrt(2), 1e-6);
}

TEST(RatioCurve, AFlatOneTellsNothing) {
  EXPECT_TRUE(std::isinf(RatioCurve().Estimate(0).deviation));
  EXPECT_EQ(RatioCurve().Estimate(0).contradiction, 0);
}

// A ratio that predicts more precisely is likelier, but contradicts only what fits worse.
TEST(RatioCurve, ContradictsOnlyWhatDoesNotFit) {
  RatioCurve curve;
  for (int i = 0; i < RatioCurve::kPoints; ++i) {
    curve.Set(i, -50 * std::pow(RatioCurve::LogRatio(i) - 2, 2), 0);
  }
  EXPECT_NEAR(curve.Estimate(0).log_ratio, 2, 1e-6);
  EXPECT_EQ(curve.Estimate(0).contradiction, 0);
}

}  // namespace
}  // namespace plm_vins

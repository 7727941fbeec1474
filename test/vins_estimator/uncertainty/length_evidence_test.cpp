// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/length_evidence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins {
namespace {

constexpr double kPrior = 0.002;
constexpr double kConsidered = 0.0075;  // considered

// Combines evidence and the prior's zero.
TEST(LengthEvidence, IsWhatRemainsWithoutThePrior) {
  const double prior = 1 / std::pow(kPrior, 2);
  for (const double deviation : {0.001, 0.004, 0.02}) {
    const double of_data = std::pow(deviation, -2);
    const double variance = 1 / (of_data + prior);
    const auto evidence = WithoutPrior(0.01 * of_data * variance, variance, kPrior);
    ASSERT_TRUE(evidence);
    EXPECT_NEAR(evidence->error, 0.01, 1e-12);
    EXPECT_NEAR(evidence->deviation, std::hypot(deviation, kConsidered), 1e-12);
  }
}

TEST(LengthEvidence, DoesNotExistWhereThePriorAloneDecides) {
  EXPECT_FALSE(WithoutPrior(0, kPrior * kPrior, kPrior));
}

TEST(LengthEvidence, IsSignificantBeyondFiveStandardDeviations) {
  EXPECT_FALSE((LengthEvidence{0.0149, 0.003}.IsSignificant()));
  EXPECT_TRUE((LengthEvidence{-0.0151, 0.003}.IsSignificant()));
}

}  // namespace
}  // namespace plm_vins

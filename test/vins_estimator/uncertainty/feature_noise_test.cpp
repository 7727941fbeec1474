// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/feature_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/marginalization/window_estimate.h"

namespace plm_vins {
namespace {

constexpr double kSigma = 0.002;
constexpr int kViews = 10;
constexpr int kLandmarks = 4000;

// Residuals of many landmarks with this correlation between consecutive errors, after a fit of two
// parameters, their mean. One observation of each landmark is off by `mistake`.
std::vector<ResidualSpread> Simulate(double correlation, int landmarks = kLandmarks,
                                     double mistake = 0) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0, kSigma);
  const auto draw = [&] { return Eigen::Vector2d(normal(generator), normal(generator)); };
  std::vector<ResidualSpread> spreads;
  for (int i = 0; i < landmarks; ++i) {
    std::vector<Eigen::Vector2d> residuals = {draw()};
    while (residuals.size() < kViews) {
      residuals.push_back(correlation * residuals.back() +
                          std::sqrt(1 - correlation * correlation) * draw());
    }
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& residual : residuals) mean += residual / kViews;
    for (Eigen::Vector2d& residual : residuals) residual -= mean;
    residuals[i % kViews].x() += mistake;
    spreads.push_back(SpreadOf(residuals, 2));
  }
  return spreads;
}

TEST(EffectiveNoise, IsTheDeviationOfIndependentObservations) {
  EXPECT_NEAR(EffectiveNoise(Simulate(0)).value(), kSigma, 0.05 * kSigma);
}

TEST(EffectiveNoise, GrowsWithCorrelatedErrors) {
  const double independent = EffectiveNoise(Simulate(0)).value();
  double before = independent;
  for (const double correlation : {0.3, 0.6}) {
    const double noise = EffectiveNoise(Simulate(correlation)).value();
    EXPECT_GT(noise, 1.05 * before) << correlation;
    before = noise;
  }
  // The mean of correlated observations is less certain by this factor, a part of which is lost in
  // the fit.
  const double expected = std::sqrt((1 + 0.3) / (1 - 0.3));
  EXPECT_NEAR(EffectiveNoise(Simulate(0.3)).value() / independent, expected, 0.15 * expected);
}

TEST(EffectiveNoise, IsRobustAgainstAFewLandmarks) {
  std::vector<ResidualSpread> spreads = Simulate(0);
  const double clean = EffectiveNoise(spreads).value();
  for (size_t i = 0; i < spreads.size() / 50; ++i) spreads[i] = {1.0, 1.0};
  EXPECT_LT(EffectiveNoise(spreads).value(), 1.15 * clean);
}

TEST(EffectiveNoise, IsRobustAgainstAnOutlierInEveryLandmark) {
  const double clean = EffectiveNoise(Simulate(0)).value();
  const double wrong = EffectiveNoise(Simulate(0, kLandmarks, 100 * kSigma)).value();
  EXPECT_LT(wrong, 1.5 * clean);
  EXPECT_GT(wrong, clean);
}

TEST(EffectiveNoise, IsUnknownForTooFewOrExactLandmarks) {
  EXPECT_FALSE(EffectiveNoise(Simulate(0, 5)));
  EXPECT_FALSE(EffectiveNoise({}));
  EXPECT_FALSE(EffectiveNoise(std::vector<ResidualSpread>(20)));
}

// Point noise learned from two windows, in motion or at standstill.
double LearnPointNoise(double first, bool moved) {
  FeatureNoise noise(first, first);
  for (const size_t frames : {7, 9}) {
    WindowEstimate estimate(
        testing::SimulateWindow(frames, /*seed=*/1, /*stride=*/5, /*max_points=*/60));
    SlidingWindow& window = estimate.map.window;
    simulator::Random random(1);
    testing::Disturb(0.003, &random, &window);
    for (WindowFrame& frame : window.frames) {
      if (!moved) frame.state.position() = window.newest().state.position();
    }
    noise.Update(estimate.map);
  }
  return noise.point();
}

TEST(FeatureNoise, IsLearnedInMotionOnly) {
  EXPECT_GT(LearnPointNoise(1e-4, true), 1e-4);
  EXPECT_EQ(LearnPointNoise(1e-4, false), 1e-4);
}

}  // namespace
}  // namespace plm_vins

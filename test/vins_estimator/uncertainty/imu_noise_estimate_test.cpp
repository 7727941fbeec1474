// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/imu_noise_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/random.h"

namespace plm_vins {
namespace {

constexpr double kConfigured = 0.01;

// Adds evidence of intervals with noise `truth` whose motion is known from images to the standard
// deviation `images`. The noise is assumed as estimated so far.
void AddIntervals(int count, double truth, double images, simulator::Random* random,
                  DensityEstimate* estimate) {
  constexpr double kDegrees = 3;
  const auto square = [](double x) { return x * x; };
  for (int i = 0; i < count; ++i) {
    const double assumed = estimate->density();
    const double share = square(assumed) / (square(assumed) + square(images));
    const double ratio = (square(truth) + square(images)) / (square(assumed) + square(images));
    estimate->Add(
        {assumed, share * ratio * random->NormalVector3().squaredNorm(), kDegrees * share});
  }
}

TEST(DensityEstimate, FindsTheDensity) {
  simulator::Random random(1);
  for (const double images : {0.0, 1.0, 2.0}) {
    DensityEstimate estimate(kConfigured);
    AddIntervals(400, 5 * kConfigured, images * kConfigured, &random, &estimate);
    // The standard deviation is 7 % with the estimate's memory.
    EXPECT_NEAR(estimate.density(), 5 * kConfigured, 0.21 * 5 * kConfigured) << images;
  }
}

TEST(DensityEstimate, FollowsChanges) {
  simulator::Random random(1);
  DensityEstimate estimate(kConfigured);
  AddIntervals(100, 5 * kConfigured, 0, &random, &estimate);
  EXPECT_GT(estimate.density(), 4 * kConfigured);
  AddIntervals(300, 2 * kConfigured, 0, &random, &estimate);
  EXPECT_NEAR(estimate.density(), 2 * kConfigured, 0.21 * 2 * kConfigured);
}

TEST(DensityEstimate, IsNeverLessThanConfigured) {
  simulator::Random random(1);
  DensityEstimate estimate(kConfigured);
  AddIntervals(100, 0.1 * kConfigured, 0, &random, &estimate);
  EXPECT_DOUBLE_EQ(estimate.density(), kConfigured);
}

TEST(DensityEstimate, IsBounded) {
  simulator::Random random(1);
  DensityEstimate estimate(kConfigured);
  AddIntervals(400, 100 * kConfigured, 0, &random, &estimate);
  EXPECT_DOUBLE_EQ(estimate.density(), 16 * kConfigured);
}

TEST(DensityEstimate, OneIntervalDoesNotDecide) {
  DensityEstimate estimate(kConfigured);
  estimate.Add({kConfigured, 1e6, 3.0});
  EXPECT_LT(estimate.density(), 2.1 * kConfigured);
}

TEST(DensityEstimate, IgnoresUninformativeIntervals) {
  DensityEstimate estimate(kConfigured);
  for (int i = 0; i < 100; ++i) estimate.Add({kConfigured, 1.0, i % 2 == 0 ? 1e-4 : -1e-4});
  estimate.Add({kConfigured, 1.0, std::nan("")});
  estimate.Add({kConfigured, std::nan(""), 1.0});
  EXPECT_DOUBLE_EQ(estimate.density(), kConfigured);
}

// Robust losses hide a part of the noise: 0.21 of the accelerometer's variance, 0.47 of the
// gyroscope's. The accelerometer is expected to have up to three times the variance that vibrations
// add.
TEST(ImuNoiseEstimate, SeparatesAccelerometerAndGyro) {
  const ImuNoise configured = {1e-4, 1e-2, 1e-5, 1e-3};
  ImuNoiseEstimate estimate(configured);
  for (int i = 0; i < 100; ++i) {
    const double assumed = estimate.noise().accel_density, ratio = 3e-2 / assumed;
    estimate.Add({{assumed, 0.79 * 3 * ratio * ratio, 3, 3}, {1e-4, 0.53 * 3, 3, 3}});
  }
  EXPECT_NEAR(estimate.noise().accel_density, std::sqrt(1e-4 + 3 * (9e-4 - 1e-4)), 2e-3);
  EXPECT_DOUBLE_EQ(estimate.noise().gyro_density, 1e-4);
  EXPECT_EQ(estimate.noise().accel_walk, configured.accel_walk);
  EXPECT_EQ(estimate.noise().gyro_walk, configured.gyro_walk);
}

}  // namespace
}  // namespace plm_vins

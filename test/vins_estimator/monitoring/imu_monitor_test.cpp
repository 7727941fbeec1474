// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/imu_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/measurements.h"

namespace plm_vins {
namespace {

ImuMonitor::Evidence At(double t, double chi_square) {
  return {ToNanoseconds(t), chi_square, 100, 2};
}

TEST(ImuMonitor, TrustsConsistentNoise) {
  ImuMonitor monitor;
  std::mt19937 random(1);
  std::chi_squared_distribution<double> chi_square(0.5);
  for (int i = 0; i < 2000; ++i) {
    EXPECT_FALSE(monitor.Add(At(0.05 * i, chi_square(random))));
    EXPECT_EQ(monitor.noise_scale(), 1);
  }
}

TEST(ImuMonitor, OneContradictingImageRaisesTheNoise) {
  ImuMonitor monitor;
  EXPECT_FALSE(monitor.Add(At(0, 0.5)));
  const auto scale = monitor.Add(At(0.05, 90));
  ASSERT_TRUE(scale.has_value());
  EXPECT_DOUBLE_EQ(*scale, 30);
  EXPECT_EQ(monitor.noise_scale(), 1);  // a single image may be an outlier
}

TEST(ImuMonitor, SeveralSlightContradictionsRaiseTheNoise) {
  ImuMonitor monitor;
  int images = 1;
  while (images < 100 && !monitor.Add(At(0.05 * images, 9))) ++images;
  EXPECT_EQ(images, 5);  // 5 x (9 - 3) > 24
}

TEST(ImuMonitor, WaitsASecondForTheBiases) {
  ImuMonitor monitor;
  int doubts = 0;
  for (int i = 0; i < 40; ++i) doubts += monitor.Add(At(0.05 * i, 60)) ? 1 : 0;
  EXPECT_EQ(doubts, 2);
}

TEST(ImuMonitor, LargeContradictionsRaiseTheNoiseFurther) {
  ImuMonitor monitor;
  EXPECT_FALSE(monitor.Add({0, 0.5, 100, 50}));
  EXPECT_FALSE(monitor.Add({50'000'000, 0.5, 19, 19}));
  EXPECT_GE(monitor.Add({100'000'000, 0.5, 100, 51}).value_or(0), 1e3);
}

TEST(ImuMonitor, FollowsLastingNoiseAndItsEnd) {
  ImuMonitor monitor;
  const double true_scale = 50;
  int i = 0;
  for (; i < 200; ++i) monitor.Add(At(0.05 * i, true_scale / monitor.noise_scale()));
  EXPECT_NEAR(monitor.noise_scale(), true_scale, 0.1 * true_scale);
  for (; i < 400; ++i) monitor.Add(At(0.05 * i, 0.5 / monitor.noise_scale()));
  EXPECT_EQ(monitor.noise_scale(), 1);
}

// An image with a small contradiction: a rotation residual along a constant axis or of alternating
// sign.
ImuMonitor::Evidence Turned(int image, double turn) {
  ImuMonitor::Evidence evidence = At(0.05 * image, image < 10 ? 4 : 1.5);
  evidence.turn_residual = turn * Eigen::Vector3d(1, -1, 1);
  return evidence;
}

TEST(ImuMonitor, ConstantContradictionIsABias) {
  ImuMonitor monitor;
  int images = 1;
  while (images < 100 && !monitor.Add(Turned(images, 2e-3))) ++images;
  EXPECT_LT(images, 40);  // two seconds
  EXPECT_EQ(monitor.noise_scale(), 1);
}

TEST(ImuMonitor, AlternatingContradictionIsNoBias) {
  ImuMonitor monitor;
  for (int i = 0; i < 200; ++i) EXPECT_FALSE(monitor.Add(Turned(i, 2e-3 * std::sin(0.3 * i))));
  EXPECT_GT(monitor.noise_scale(), 1);
}

}  // namespace
}  // namespace plm_vins

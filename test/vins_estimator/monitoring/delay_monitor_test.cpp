// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/delay_monitor.h"

#include <gtest/gtest.h>

#include <random>

namespace plm_vins {
namespace {

// Two hundred images of a flight with rotations, a delay [s] and other errors of this size [rad].
std::optional<double> Fly(double delay, double noise, double turns = 0.3) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) {
    return Eigen::Vector3d(size * normal(random), size * normal(random), size * normal(random));
  };
  DelayMonitor monitor;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d change = vector(turns);
    monitor.Add(delay * change + vector(noise), change);
  }
  return monitor.delay();
}

TEST(DelayMonitor, MeasuresTheDelay) {
  EXPECT_NEAR(Fly(0.02, 0.003).value_or(0), 0.02, 0.003);
  EXPECT_NEAR(Fly(-0.02, 0.003).value_or(0), -0.02, 0.003);
}

TEST(DelayMonitor, IgnoresOtherErrors) {
  EXPECT_FALSE(Fly(0, 0.001));
  EXPECT_FALSE(Fly(0, 0.02));
}

TEST(DelayMonitor, IgnoresSmallDelaysAndNeedsRotation) {
  EXPECT_FALSE(Fly(0.001, 0.0001));
  EXPECT_FALSE(Fly(0.02, 0.0, 1e-4));
}

}  // namespace
}  // namespace plm_vins

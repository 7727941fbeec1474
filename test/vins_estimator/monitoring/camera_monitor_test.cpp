// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/camera_monitor.h"

#include <gtest/gtest.h>

#include "common/measurements.h"
#include "simulator/random.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;

constexpr double kNoise = 1e-3;
constexpr CameraNoise kConfigured = {/*point=*/kNoise, /*line=*/kNoise};

// Residuals of a camera with this noise, offset and delay [s], for some seconds at 10 Hz.
CameraMonitor Watch(double seconds, double noise, const Vector2d& offset, double delay = 0) {
  CameraMonitor monitor(/*camera=*/1, kConfigured);
  simulator::Random random(1);
  for (int image = 0; image < 10 * seconds; ++image) {
    std::vector<PointResidual> residuals(50);
    const Vector2d flow = 0.5 * Vector2d(random.Normal(), random.Normal());
    for (PointResidual& residual : residuals) {
      residual.flow = flow + 0.1 * Vector2d(random.Normal(), random.Normal());
      const Vector2d noise_xy = noise * Vector2d(random.Normal(), random.Normal());
      residual.error = noise_xy + offset - delay * residual.flow;
    }
    monitor.Add(ToNanoseconds(0.1 * image), residuals);
  }
  return monitor;
}

TEST(CameraMonitor, LearnsTheNoise) {
  EXPECT_NEAR(Watch(3, 2 * kNoise, {0, 0}).noise(), 2 * kNoise, 0.2 * kNoise);
  EXPECT_NEAR(Watch(3, 0.1 * kNoise, {0, 0}).noise(), kNoise, 1e-12) << "not less than the first";
  EXPECT_FALSE(Watch(3, 2 * kNoise, {0, 0}).misfit());
}

TEST(CameraMonitor, ReportsAMiscalibratedCameraAndRemovesItsWeight) {
  const CameraMonitor monitor = Watch(3, kNoise, {0, 8 * kNoise});
  ASSERT_TRUE(monitor.misfit());
  EXPECT_NEAR(*monitor.misfit(), 8 * kNoise, 0.5 * kNoise);
  EXPECT_GT(monitor.noise(), 100 * kNoise);
}

TEST(CameraMonitor, MeasuresTheDelayOfTheExposure) {
  EXPECT_NEAR(Watch(3, kNoise, {0, 0}, 0.005).delay().value_or(0), 0.005, 0.0005);
  EXPECT_NEAR(Watch(3, kNoise, {0, 0}, -0.02).delay().value_or(0), -0.02, 0.001);
  EXPECT_FALSE(Watch(3, kNoise, {0, 0}, 0).delay());
}

// Returns the monitor of a camera that fits, after lines whose residuals are `error` deviations.
CameraMonitor WatchLines(double error) {
  CameraMonitor monitor = Watch(3, kNoise, {0, 0});
  std::vector<LineResidual> residuals(20);
  for (LineResidual& residual : residuals) residual.error = error;
  for (int image = 0; image < 30; ++image) monitor.Add(ToNanoseconds(0.1 * image), residuals);
  return monitor;
}

TEST(CameraMonitor, WeightsLinesByTheirResiduals) {
  EXPECT_NEAR(WatchLines(0.5).line_noise_factor(0), 1, 1e-9) << "not less than stated";
  EXPECT_NEAR(WatchLines(3).line_noise_factor(0), 2.5, 0.2);
  EXPECT_FALSE(WatchLines(10).UsesLines(0));
  EXPECT_GT(WatchLines(10).line_noise_factor(0), 100);
}

TEST(CameraMonitor, UsesLinesOnlyWhilePointsFit) {
  EXPECT_FALSE(CameraMonitor(1, kConfigured).UsesLines(0));
  EXPECT_FALSE(Watch(3, kNoise, {0, 8 * kNoise}).UsesLines(ToNanoseconds(3)));
  const CameraMonitor monitor = Watch(3, kNoise, {0, 0});
  EXPECT_TRUE(monitor.UsesLines(ToNanoseconds(3)));
  EXPECT_FALSE(monitor.UsesLines(ToNanoseconds(6)));
}

}  // namespace
}  // namespace plm_vins

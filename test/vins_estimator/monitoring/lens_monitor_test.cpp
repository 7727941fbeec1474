// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/lens_monitor.h"

#include <gtest/gtest.h>

#include <functional>

#include "simulator/default_sensors.h"
#include "simulator/random.h"

namespace plm_vins {
namespace {

constexpr int kFrames = 40, kPoints = 60;

CameraParameters Camera() { return simulator::DefaultSensors().cameras[0].parameters; }

// Error of an observation by its position relative to the principal point.
using Error = std::function<Eigen::Vector2d(const Eigen::Vector2d& from_center)>;

// A monitor that has seen points all over the image, with noise of `noise_px` and the given errors.
LensMonitor MonitorOf(const CameraParameters& camera, double noise_px, const Error& error,
                      int frames = kFrames) {
  simulator::Random random(3);
  LensMonitor monitor(camera);
  for (int i = 0; i < frames; ++i) {
    std::vector<PixelResidual> residuals;
    for (int k = 0; k < kPoints; ++k) {
      const Eigen::Vector2d uv(random.Uniform(0, camera.width), random.Uniform(0, camera.height));
      const Eigen::Vector2d noise(random.Normal(), random.Normal());
      residuals.push_back(
          {uv, noise_px * noise + error(uv - Eigen::Vector2d(camera.cx, camera.cy))});
    }
    monitor.Add(residuals);
  }
  return monitor;
}

Eigen::Vector2d None(const Eigen::Vector2d&) { return Eigen::Vector2d::Zero(); }

// The part of a lens error that structure and poses do not absorb.
Eigen::Vector2d Wave(const Eigen::Vector2d& from_center) {
  const double radius = from_center.norm();
  return (radius < 200 ? -0.08 : 0.05) * from_center.normalized();
}

TEST(LensMonitorTest, RingsHaveMedianAndDeviation) {
  const auto rings = MonitorOf(Camera(), 0.2, Wave, 400).Rings();
  ASSERT_EQ(rings.size(), 8u);
  EXPECT_EQ(rings[0].inner_px, 0);
  EXPECT_NEAR(rings[7].outer_px, Eigen::Vector2d(752 - 367.215, 248.375).norm(), 1e-9);
  int64_t count = 0;
  for (size_t i = 0; i < rings.size(); ++i) {
    const ResidualRing& ring = rings[i];
    EXPECT_NEAR(ring.inner_px, static_cast<double>(i) * rings[0].outer_px, 1e-9);
    count += ring.count;
    EXPECT_NEAR(ring.deviation_px, 0.2, 0.03) << i;
    if (ring.outer_px < 200 || ring.inner_px > 200) {
      EXPECT_NEAR(ring.radial_px, ring.outer_px < 200 ? -0.08 : 0.05, 0.02) << i;
    }
  }
  EXPECT_EQ(count, 400 * kPoints);
}

TEST(LensMonitorTest, ReportsASystematicError) {
  // The medians of all rings have standard errors of at most 0.001 px, a fifth of what rounds
  // differently.
  const std::string warning = MonitorOf(Camera(), 0.02, Wave, 400).warning();
  for (const char* part : {"(-0.08 px at ", ", +0.05 px at ",
                           "the distortion model does not fit; recalibrate with an equidistant"}) {
    EXPECT_NE(warning.find(part), std::string::npos) << warning;
  }
  EXPECT_NE(MonitorOf(Camera(), 0.2, Wave).warning(), "");
  CameraParameters equidistant = Camera();
  equidistant.model = CameraParameters::Model::kPinholeEquidistant;
  const std::string advice = MonitorOf(equidistant, 0.2, Wave).warning();
  EXPECT_NE(advice.find("does not fit; recalibrate"), std::string::npos) << advice;
  EXPECT_EQ(advice.find("equidistant"), std::string::npos) << advice;
}

TEST(LensMonitorTest, NoiseIsNoWarning) {
  for (const double noise : {0.05, 0.2, 1.0}) {
    EXPECT_EQ(MonitorOf(Camera(), noise, None).warning(), "") << noise;
    EXPECT_EQ(MonitorOf(Camera(), noise, None, 5).warning(), "") << noise;
  }
}

TEST(LensMonitorTest, NoiseThatGrowsTowardsTheBorderIsNoWarning) {
  simulator::Random random(5);
  const auto blur = [&](const Eigen::Vector2d& from_center) -> Eigen::Vector2d {
    return from_center.norm() / 200 * Eigen::Vector2d(random.Normal(), random.Normal());
  };
  EXPECT_EQ(MonitorOf(Camera(), 0.2, blur).warning(), "");
}

TEST(LensMonitorTest, ARollingShutterIsNoWarning) {
  // Rows are off by the motion since the middle row, which may even have one direction.
  const auto skew = [](const Eigen::Vector2d& from_center) {
    return Eigen::Vector2d(2e-3 * from_center.y(), 0);
  };
  EXPECT_EQ(MonitorOf(Camera(), 0.2, skew).warning(), "");
}

TEST(LensMonitorTest, OutliersAreNoWarning) {
  simulator::Random random(7);
  const auto outliers = [&](const Eigen::Vector2d& from_center) -> Eigen::Vector2d {
    return random.Uniform(0, 1) < 0.1 ? Eigen::Vector2d(5 * from_center.normalized())
                                      : Eigen::Vector2d::Zero();
  };
  EXPECT_EQ(MonitorOf(Camera(), 0.1, outliers).warning(), "");
}

TEST(LensMonitorTest, NeedsManyResiduals) {
  EXPECT_EQ(MonitorOf(Camera(), 0.2, Wave, 10).warning(), "");
  EXPECT_EQ(LensMonitor(Camera()).warning(), "");
  EXPECT_EQ(LensMonitor(Camera()).Rings()[3].count, 0);
}

}  // namespace
}  // namespace plm_vins

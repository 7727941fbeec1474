// SPDX-License-Identifier: BSD-3-Clause
#include "test/feature_simulator/feature_simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace plm_vins::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

FeatureSimulationOptions Options() {
  FeatureSimulationOptions options;
  options.trajectory.duration = 8.0;
  return options;
}

FeatureSimulationOptions NoiseFree() {
  FeatureSimulationOptions options = Options();
  options.add_imu_noise = false;
  options.point_noise_px = options.line_noise_px = 0.0;
  return options;
}

Rigid3d CameraFromWorld(const FeatureSimulationOptions& options, const FrameState& state) {
  return (state.T_W_B() * options.sensors.cameras[0].T_B_C).Inverse();
}

// Calls `f(observation, true normalized point)` for every point observation.
template <typename F>
void ForEachPoint(const FeatureSimulationOptions& options, const FeatureDataset& data, F f) {
  for (size_t i = 0; i < data.truth.size(); ++i) {
    const Rigid3d T_C_W = CameraFromWorld(options, data.truth[i]);
    for (const PointObservation& point : data.points[i].points) {
      const Vector3d p_C = T_C_W * data.world.points[data.point_landmark.at(point.id)];
      f(point, Vector2d(p_C.hnormalized()));
    }
  }
}

TEST(FeatureSimulator, NoiseFreePointsAreProjectionsOfTheirLandmarks) {
  const auto options = NoiseFree();
  const FeatureDataset data = SimulateFeatures(options);
  int count = 0;
  ForEachPoint(options, data, [&](const PointObservation& point, const Vector2d& truth) {
    EXPECT_LT((point.xy - truth).norm(), 1e-4);
    ++count;
  });
  EXPECT_GT(count, 10000);
}

TEST(FeatureSimulator, NoiseFreeLinesPassThroughTheirLandmarks) {
  const auto options = NoiseFree();
  const FeatureDataset data = SimulateFeatures(options);
  int count = 0;
  for (size_t i = 0; i < data.truth.size(); ++i) {
    const Rigid3d T_C_W = CameraFromWorld(options, data.truth[i]);
    for (const LineObservation& line : data.lines[i].lines) {
      const LineSegment3d& landmark = data.world.lines[data.line_landmark.at(line.id)];
      const Vector3d normal = (T_C_W * landmark.start).cross(T_C_W * landmark.end);
      const Vector3d image_line = normal / normal.head<2>().norm();
      EXPECT_NEAR(image_line.dot(line.start.homogeneous()), 0, 1e-4);
      EXPECT_NEAR(image_line.dot(line.end.homogeneous()), 0, 1e-4);
      ++count;
    }
  }
  EXPECT_GT(count, 1000);
}

TEST(FeatureSimulator, FramesShareStampsAndKeepTheLimits) {
  const FeatureDataset data = SimulateFeatures(Options());
  ASSERT_EQ(data.truth.size(), 160u);
  ASSERT_EQ(data.points.size(), data.truth.size());
  ASSERT_EQ(data.lines.size(), data.truth.size());
  for (size_t i = 0; i < data.truth.size(); ++i) {
    EXPECT_EQ(data.points[i].t_ns, data.truth[i].t_ns);
    EXPECT_EQ(data.lines[i].t_ns, data.truth[i].t_ns);
    EXPECT_LE(data.points[i].points.size(), 150u);
    EXPECT_GE(data.points[i].points.size(), 60u);
    EXPECT_LE(data.lines[i].lines.size(), 50u);
    EXPECT_GE(data.lines[i].lines.size(), 10u);
  }
  EXPECT_LT(data.imu.front().t_ns, data.points.front().t_ns);
  EXPECT_GE(data.imu.back().t_ns, data.points.back().t_ns);
}

TEST(FeatureSimulator, PixelNoiseHasTheRequestedSize) {
  FeatureSimulationOptions options = Options();
  options.point_noise_px = 0.7;
  const FeatureDataset noisy = SimulateFeatures(options);
  const auto camera = CameraModel::Create(options.sensors.cameras[0].parameters);
  double squared = 0;
  int count = 0;
  ForEachPoint(options, noisy, [&](const PointObservation& point, const Vector2d& truth) {
    squared += (point.uv_px - *camera->Project(truth.homogeneous())).squaredNorm();
    count += 2;
  });
  EXPECT_NEAR(std::sqrt(squared / count), 0.7, 0.01);
}

TEST(FeatureSimulator, BrokenTracksContinueUnderNewIds) {
  FeatureSimulationOptions options = Options();
  options.trajectory.motion = Motion::kStill;
  EXPECT_LE(SimulateFeatures(options).point_landmark.size(), 150u);
  options.point_break_probability = 0.05;
  const FeatureDataset data = SimulateFeatures(options);
  EXPECT_GT(data.point_landmark.size(), 500u);
  std::set<int> landmarks;
  for (const auto& [id, landmark] : data.point_landmark) landmarks.insert(landmark);
  EXPECT_LT(landmarks.size(), 300u);
}

TEST(FeatureSimulator, OutliersHaveTheRequestedShare) {
  FeatureSimulationOptions options = Options();
  options.point_outlier_ratio = 0.1;
  const FeatureDataset data = SimulateFeatures(options);
  int outliers = 0, count = 0;
  ForEachPoint(options, data, [&](const PointObservation& point, const Vector2d& truth) {
    outliers += (point.xy - truth).norm() * options.sensors.cameras[0].parameters.fx > 4.0;
    ++count;
  });
  EXPECT_NEAR(outliers / double(count), 0.1, 0.01);
}

TEST(FeatureSimulator, SameSeedSameBytesOtherSeedOtherData) {
  FeatureSimulationOptions options = Options();
  const FeatureDataset a = SimulateFeatures(options), b = SimulateFeatures(options);
  options.seed = 2;
  const FeatureDataset c = SimulateFeatures(options);
  EXPECT_EQ(a.imu[500].accel, b.imu[500].accel);
  EXPECT_EQ(a.truth[99].pose, b.truth[99].pose);
  EXPECT_EQ(a.points[99].points[7].uv_px, b.points[99].points[7].uv_px);
  EXPECT_EQ(a.lines[99].lines[4].end, b.lines[99].lines[4].end);
  EXPECT_NE(a.points[99].points[7].uv_px, c.points[99].points[7].uv_px);
  EXPECT_NE(a.imu[500].accel, c.imu[500].accel);
}

}  // namespace
}  // namespace plm_vins::simulator

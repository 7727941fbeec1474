// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/recalibration.h"

#include <gtest/gtest.h>

#include "simulator/default_sensors.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;

class RecalibrationTest : public ::testing::Test {
 protected:
  static CameraParameters Other() {
    CameraParameters camera = simulator::DefaultSensors().cameras[0].parameters;
    camera.fx *= 1.02;
    camera.cy += 7;
    camera.distortion[0] += 0.01;
    return camera;
  }

  // Returns the image point of the other camera for the pixel of `xy` in the first.
  Vector2d Expected(const Vector2d& xy) const {
    return *to_->Unproject(*from_->Project(xy.homogeneous()));
  }

  const std::unique_ptr<const CameraModel> from_ =
      CameraModel::Create(simulator::DefaultSensors().cameras[0].parameters);
  const std::unique_ptr<const CameraModel> to_ = CameraModel::Create(Other());
  const Recalibration recalibration_{simulator::DefaultSensors().cameras[0].parameters, Other()};
};

TEST_F(RecalibrationTest, ReturnsTheLargestMotion) {
  CameraParameters camera = simulator::DefaultSensors().cameras[0].parameters;
  EXPECT_EQ(Recalibration(camera, camera).LargestMove(), 0);

  camera.distortion.setZero();
  CameraParameters moved = camera;
  moved.cx += 2;
  EXPECT_NEAR(Recalibration(camera, moved).LargestMove(), 2 / camera.fx, 1e-12);

  Vector2d xy = *from_->Unproject(Vector2d(0, 0));
  const Vector2d before = xy;
  recalibration_.Move(&xy);
  EXPECT_GE(recalibration_.LargestMove(), (xy - before).norm());
}

TEST_F(RecalibrationTest, MovesAllRaysOfAnImage) {
  FrameMeasurement measurement;
  measurement.points.points = {{1, {0.1, 0.2}, {300, 200}, {1, 0}}};
  recalibration_.Move(0, &measurement);  // without lines
  const PointObservation& point = measurement.points.points[0];
  EXPECT_MATRIX_NEAR(point.xy, Expected({0.1, 0.2}), 1e-12);
  EXPECT_EQ(point.uv_px, Vector2d(300, 200));
  EXPECT_NE(point.velocity, Vector2d(1, 0));

  measurement.lines = LineFrame{0, {{1, {0.1, 0.2}, {-0.3, 0.4}}}};
  recalibration_.Move(0, &measurement);
  EXPECT_MATRIX_NEAR(measurement.lines->lines[0].start, Expected({0.1, 0.2}), 1e-12);
  EXPECT_MATRIX_NEAR(measurement.lines->lines[0].end, Expected({-0.3, 0.4}), 1e-12);
}

TEST_F(RecalibrationTest, MovesAllRaysOfAMap) {
  const LineLandmark::Observation observation{{7, 0}, {{0.1, 0.2}, {-0.3, 0.4}}};
  LocalMap map(LocalMapOptions(0.001, /*remember_lines=*/true));
  PointLandmark& point = map.points.landmarks()[1];
  point.observations.resize(2);
  point.observations[1].bearing.xy = {0.1, 0.2};
  LineLandmark& line = map.lines.landmarks()[2];
  line.observations = line.anchor_observations = {observation};
  map.memory.Keep(3, SeenLine());
  map.memory.KeepObservation(3, observation);

  recalibration_.Move(0, &map);
  EXPECT_MATRIX_NEAR(point.observations[0].bearing.xy, Expected({0, 0}), 1e-12);
  EXPECT_MATRIX_NEAR(point.observations[1].bearing.xy, Expected({0.1, 0.2}), 1e-12);
  for (const LineLandmark::Observation& moved : {line.observations[0], line.anchor_observations[0],
                                                 map.memory.Find(3)->anchor_observations[0]}) {
    EXPECT_MATRIX_NEAR(moved.segment.start, Expected({0.1, 0.2}), 1e-12);
    EXPECT_MATRIX_NEAR(moved.segment.end, Expected({-0.3, 0.4}), 1e-12);
  }
}

TEST_F(RecalibrationTest, MovesTheRaysOfOneCameraAlone) {
  FrameMeasurement measurement;
  measurement.points.points.resize(2);
  measurement.lines = LineFrame{0, {{1, {0.1, 0.2}, {-0.3, 0.4}}, {1, {0.1, 0.2}, {-0.3, 0.4}}}};
  measurement.points.points[1].camera = measurement.lines->lines[1].camera = 1;
  measurement.points.points[0].xy = measurement.points.points[1].xy = Vector2d(0.1, 0.2);
  recalibration_.Move(1, &measurement);
  EXPECT_EQ(measurement.points.points[0].xy, Vector2d(0.1, 0.2));
  EXPECT_MATRIX_NEAR(measurement.points.points[1].xy, Expected({0.1, 0.2}), 1e-12);
  EXPECT_EQ(measurement.lines->lines[0].end, Vector2d(-0.3, 0.4));
  EXPECT_MATRIX_NEAR(measurement.lines->lines[1].start, Expected({0.1, 0.2}), 1e-12);
  EXPECT_MATRIX_NEAR(measurement.lines->lines[1].end, Expected({-0.3, 0.4}), 1e-12);
}

TEST_F(RecalibrationTest, FollowsTheIntrinsicsOfEachCamera) {
  LocalMap map(LocalMapOptions(0.001, /*remember_lines=*/true));
  PointLandmark& point = map.points.landmarks()[1];
  point.observations.resize(2);
  LineLandmark& line = map.lines.landmarks()[2];
  line.observations.resize(2);
  for (int camera = 0; camera < 2; ++camera) {
    point.observations[camera].camera = line.observations[camera].camera = camera;
    point.observations[camera].bearing.xy = {0.1, 0.2};
    line.observations[camera].segment = {{0.1, 0.2}, {-0.3, 0.4}};
  }
  SensorConfig sensor = simulator::DefaultStereoSensors();
  sensor.cameras[1].parameters = sensor.cameras[0].parameters;
  std::vector<WindowCamera>& cameras = map.window.cameras;
  cameras.resize(2);
  for (WindowCamera& camera : cameras) {
    camera.intrinsics = camera.ray_intrinsics = sensor.cameras[0].parameters.intrinsics();
  }
  cameras[1].intrinsics = Other().intrinsics();
  FollowIntrinsics(sensor, /*max_error=*/1, &map);
  EXPECT_EQ(point.observations[1].bearing.xy, Vector2d(0.1, 0.2));
  FollowIntrinsics(sensor, /*max_error=*/1e-4, &map);
  EXPECT_EQ(cameras[1].ray_intrinsics, cameras[1].intrinsics);
  EXPECT_MATRIX_NEAR(point.observations[1].bearing.xy, Expected({0.1, 0.2}), 1e-12);
  EXPECT_MATRIX_NEAR(line.observations[1].segment.end, Expected({-0.3, 0.4}), 1e-12);
  EXPECT_EQ(point.observations[0].bearing.xy, Vector2d(0.1, 0.2));
  EXPECT_EQ(line.observations[0].segment.end, Vector2d(-0.3, 0.4));
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/rolling_shutter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/camera/camera_model.h"
#include "common/geometry/rigid3.h"
#include "common/geometry/so3.h"
#include "simulator/default_sensors.h"
#include "simulator/random.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kReadout = 0.03;   // [s]
constexpr double kInterval = 0.05;  // between images [s]

// A camera that moves and rotates with acceleration past points and lines. B and C differ in
// attitude only.
class RollingCamera {
 public:
  explicit RollingCamera(const Vector3d& angular_acceleration_C)
      : angular_acceleration_C_(angular_acceleration_C) {
    simulator::Random random(1);
    for (int i = 0; i < 300; ++i) {
      points_C0_.push_back({random.Uniform(-3, 3), random.Uniform(-2, 2), random.Uniform(2.5, 6)});
    }
  }

  const CameraParameters& parameters() const { return camera_->parameters(); }
  const Eigen::Quaterniond& R_B_C() const { return R_B_C_; }
  double focal_length() const { return camera_->FocalLength(); }

  // Angular velocity in C at a time since the first image.
  Vector3d Rate(double t) const { return Vector3d(0.5, -0.6, 0.7) + t * angular_acceleration_C_; }

  // Transforms a point from the first camera to the camera at a time.
  Vector3d InCamera(const Vector3d& p_C0, double t) const {
    const Vector3d turn = t * (Rate(0) + Rate(t)) / 2;
    return SO3Exp(turn).conjugate() * (p_C0 - t * Vector3d(1.5, -0.8, 0.6));
  }

  Vector2d AtStamp(const Vector3d& p_C0, double t) const { return InCamera(p_C0, t).hnormalized(); }

  // Pixel of the point in the image of that time, or nullopt if it is not in view.
  std::optional<Vector2d> Pixel(const Vector3d& p_C0, double t) const {
    double share = 0;
    std::optional<Vector2d> pixel;
    for (int i = 0; i < 6; ++i) {
      pixel = camera_->Project(InCamera(p_C0, t + share * kReadout));
      if (!pixel || !camera_->IsInImage(*pixel)) return std::nullopt;
      share = ReadoutShare(pixel->y(), parameters().height);
    }
    return pixel;
  }

  // Returns the image with the points, and lines from each point to the next, except every third.
  FrameMeasurement Image(double t) const {
    FrameMeasurement image;
    image.t_ns = image.points.t_ns = ToNanoseconds(1000 + t);
    image.lines.emplace();
    image.lines->t_ns = image.t_ns;
    for (size_t i = 0; i < points_C0_.size(); ++i) {
      const auto pixel = Pixel(points_C0_[i], t);
      if (!pixel) continue;
      const int64_t id = static_cast<int64_t>(i);
      image.points.points.push_back({id, *camera_->Unproject(*pixel), *pixel, {0, 0}});
      const auto end = i + 1 < points_C0_.size() ? Pixel(points_C0_[i + 1], t) : std::nullopt;
      if (end) {
        image.lines->lines.push_back({id, *camera_->Unproject(*pixel), *camera_->Unproject(*end)});
      }
    }
    for (double s = t - kInterval; s < t + 1e-9; s += 0.005) {
      const Vector3d gyro = R_B_C_ * Rate(s) + Vector3d(0.05, -0.03, 0.02);  // with a bias
      image.imu.push_back({ToNanoseconds(1000 + s), gyro, Vector3d::Zero()});
    }
    return image;
  }

  const std::vector<Vector3d>& points_C0() const { return points_C0_; }

 private:
  std::unique_ptr<const CameraModel> camera_ =
      CameraModel::Create(simulator::DefaultSensors().cameras[0].parameters);
  Eigen::Quaterniond R_B_C_ = SO3Exp({1, 2, -0.5});
  Vector3d angular_acceleration_C_;
  std::vector<Vector3d> points_C0_;
};

// Root mean square distance of an image's points from their positions at the timestamp [px].
double PointError(const RollingCamera& camera, double t, const FrameMeasurement& image) {
  double sum = 0;
  for (const PointObservation& point : image.points.points) {
    sum += (point.xy - camera.AtStamp(camera.points_C0()[point.id], t)).squaredNorm();
  }
  return camera.focal_length() * std::sqrt(sum / static_cast<double>(image.points.points.size()));
}

// Root mean square distance of the lines' endpoints from the true lines at the timestamp [px].
double LineError(const RollingCamera& camera, double t, const FrameMeasurement& image) {
  double sum = 0;
  for (const LineObservation& line : image.lines->lines) {
    const Vector3d normal =
        camera.AtStamp(camera.points_C0()[line.id], t)
            .homogeneous()
            .cross(camera.AtStamp(camera.points_C0()[line.id + 1], t).homogeneous());
    for (const Vector2d& end : {line.start, line.end}) {
      sum += std::pow(normal.dot(end.homogeneous()) / normal.head<2>().norm(), 2) / 2;
    }
  }
  return camera.focal_length() * std::sqrt(sum / static_cast<double>(image.lines->lines.size()));
}

// The corrected second image of a flight.
FrameMeasurement Moved(const RollingCamera& camera) {
  RollingShutter shutter({CameraSensor{"", camera.parameters(), {}}});
  shutter.ToStamp(camera.Image(0), {camera.R_B_C()}, kReadout);
  return shutter.ToStamp(camera.Image(kInterval), {camera.R_B_C()}, kReadout);
}

TEST(RollingShutter, MovesPointsAndLinesToTheStamp) {
  const RollingCamera camera(Vector3d::Zero());
  const FrameMeasurement moved = Moved(camera), seen = camera.Image(kInterval);
  ASSERT_GT(moved.points.points.size(), 80u);
  ASSERT_GT(moved.lines->lines.size(), 30u);
  EXPECT_GT(PointError(camera, kInterval, seen), 2);
  EXPECT_LT(PointError(camera, kInterval, moved), 0.1);
  EXPECT_GT(LineError(camera, kInterval, seen), 2);
  EXPECT_LT(LineError(camera, kInterval, moved), 0.1);
}

TEST(RollingShutter, GyroGivesTheChangeOfMotion) {
  const RollingCamera camera(Vector3d(8, -6, 5));
  FrameMeasurement first = camera.Image(0), second = camera.Image(kInterval);
  const FrameMeasurement moved = Moved(camera);
  for (ImuSample& sample : second.imu) sample.gyro.setZero();
  RollingShutter deaf({CameraSensor{"", camera.parameters(), {}}});
  deaf.ToStamp(first, {camera.R_B_C()}, kReadout);
  const FrameMeasurement by_tracks = deaf.ToStamp(second, {camera.R_B_C()}, kReadout);
  EXPECT_LT(PointError(camera, kInterval, moved), 0.6 * PointError(camera, kInterval, by_tracks));
  EXPECT_LT(LineError(camera, kInterval, moved), 0.6 * LineError(camera, kInterval, by_tracks));
}

TEST(RollingShutter, PointsGetTheirVelocity) {
  const RollingCamera camera(Vector3d::Zero());
  for (const PointObservation& point : Moved(camera).points.points) {
    const Vector3d& p_C0 = camera.points_C0()[point.id];
    const Vector2d velocity =
        (camera.AtStamp(p_C0, kInterval + 1e-4) - camera.AtStamp(p_C0, kInterval - 1e-4)) / 2e-4;
    EXPECT_LT((point.velocity - velocity).norm(), 0.02 + 0.05 * velocity.norm());
  }
}

TEST(RollingShutter, IgnoresNewFeatures) {
  const RollingCamera camera(Vector3d::Zero());
  RollingShutter shutter({CameraSensor{"", camera.parameters(), {}}});
  FrameMeasurement first = camera.Image(0);
  first.points.points.resize(10);
  first.lines.reset();
  const FrameMeasurement moved = shutter.ToStamp(first, {camera.R_B_C()}, kReadout);
  EXPECT_TRUE(moved.points.points.empty());
  EXPECT_FALSE(moved.lines);
  const FrameMeasurement second =
      shutter.ToStamp(camera.Image(kInterval), {camera.R_B_C()}, kReadout);
  EXPECT_GT(second.points.points.size(), 5u);
  EXPECT_LE(second.points.points.size(), 10u);
  EXPECT_TRUE(second.lines->lines.empty());
}

// A match in a second camera has no observation in the previous image.
TEST(RollingShutter, MatchesMoveLikeTheFirstCamera) {
  const RollingCamera camera(Vector3d::Zero());
  const CameraSensor sensor{"", camera.parameters(), {}};
  RollingShutter shutter({sensor, sensor});
  const std::vector<Eigen::Quaterniond> R_B_C = {camera.R_B_C(), camera.R_B_C()};
  shutter.ToStamp(camera.Image(0), R_B_C, kReadout);
  FrameMeasurement second = camera.Image(kInterval);
  PointObservation match = second.points.points.front();
  match.camera = 1;
  second.points.points.push_back(match);
  const FrameMeasurement moved = shutter.ToStamp(second, R_B_C, kReadout);
  EXPECT_EQ(moved.points.points.back().xy, moved.points.points.front().xy);
  EXPECT_EQ(moved.points.points.back().velocity, moved.points.points.front().velocity);
}

}  // namespace
}  // namespace plm_vins

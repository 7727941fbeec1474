// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/intrinsics_factor.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "simulator/default_sensors.h"
#include "test/vins_estimator/factors/factor_scene.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Block;
using testing::ScalarBlock;

constexpr double kWeight = 2;
constexpr ChainKind kHost = {/*same_frame=*/true, /*same_camera=*/true};

// The camera with which the rays were computed, and similar intrinsics.
class IntrinsicsFactorTest : public ::testing::Test {
 protected:
  IntrinsicsFactorTest() : intrinsics_(kIntrinsicsSize) {
    intrinsics_ << 1, -2, 3, -4, 0.01, -0.01, 0.001, -0.001;
    intrinsics_ += camera_->parameters().intrinsics();
  }

  Block LineBlock() const {
    return testing::LineBlockOf(LineThrough({0.4, -0.8, 4}, {-1, 0.8, 5}));
  }

  PointFactor PlainPoint(const ChainKind& kind) const { return {kind, bearing_, kWeight}; }
  PointIntrinsicsFactor Point(const ChainKind& kind) const {
    return {PlainPoint(kind), RayShift(*camera_, bearing_.xy)};
  }

  LineFactor PlainLine(const ChainKind& kind) const { return {kind, view_, {kWeight, 3}}; }
  LineIntrinsicsFactor Line(const ChainKind& kind) const {
    return {PlainLine(kind), RayShift(*camera_, view_.start), RayShift(*camera_, view_.end)};
  }

  // The ray of the pixel of `xy` with other intrinsics.
  Vector2d Recalibrated(const Vector2d& xy, const Block& intrinsics) const {
    const auto other = CameraModel::Create(camera_->parameters().With(Intrinsics(intrinsics)));
    return *other->Unproject(*camera_->Project(xy.homogeneous()));
  }

  const std::unique_ptr<const CameraModel> camera_ =
      CameraModel::Create(simulator::DefaultSensors().cameras[0].parameters);
  const TimedBearing bearing_{{0.1, -0.2}, {1, 2}, 0.01};
  const SegmentEndPoints view_{{0.1, -0.2}, {-0.2, 0.15}};
  const Block point_ = Vector3d(0.12, -0.23, 0.5);
  Block intrinsics_;
};

TEST_F(IntrinsicsFactorTest, AtTheIntrinsicsOfTheRaysIsTheFactorItself) {
  const Block reference = camera_->parameters().intrinsics();
  EXPECT_MATRIX_NEAR(testing::Residual(Point(kHost), {ScalarBlock(0.02), point_, reference}),
                     testing::Residual(PlainPoint(kHost), {ScalarBlock(0.02), point_}), 1e-12);
  EXPECT_MATRIX_NEAR(testing::Residual(Line(kHost), {LineBlock(), reference}),
                     testing::Residual(PlainLine(kHost), {LineBlock()}), 1e-12);
}

TEST_F(IntrinsicsFactorTest, KeepsPixelsWithOtherIntrinsics) {
  const Block near =
      camera_->parameters().intrinsics() + 0.1 * (intrinsics_ - camera_->parameters().intrinsics());
  TimedBearing moved_bearing = bearing_;
  moved_bearing.xy = Recalibrated(bearing_.xy, near);
  const PointFactor moved_point(kHost, moved_bearing, kWeight);
  EXPECT_MATRIX_NEAR(testing::Residual(Point(kHost), {ScalarBlock(0.02), point_, near}),
                     testing::Residual(moved_point, {ScalarBlock(0.02), point_}), 1e-5);
  const SegmentEndPoints moved_view{Recalibrated(view_.start, near), Recalibrated(view_.end, near)};
  EXPECT_MATRIX_NEAR(testing::Residual(Line(kHost), {LineBlock(), near}),
                     testing::Residual(LineFactor(kHost, moved_view, {kWeight, 3}), {LineBlock()}),
                     1e-5);
}

TEST_F(IntrinsicsFactorTest, HasExactJacobians) {
  testing::ForEachScene([this](const testing::FactorScene& scene) {
    testing::ExpectTangentJacobians(
        Point(scene.kind),
        testing::Joined(scene.Poses(), {ScalarBlock(0.03), scene.Point(), intrinsics_}), 1e-6);
    testing::ExpectTangentJacobians(
        Line(scene.kind), testing::Joined(scene.Poses(), {scene.Line(), intrinsics_}), 1e-5);
  });
}

TEST_F(IntrinsicsFactorTest, KeepsRaysOutsideTheFieldOfView) {
  CameraParameters folded = camera_->parameters();
  folded.distortion = {-0.4, 0, 0, 0};  // valid up to a radius of 0.91
  const RayShift shift(*CameraModel::Create(folded), Vector2d(0.9, 0.9));
  EXPECT_EQ(shift.At(intrinsics_.data()), Vector2d(0, 0));
}

TEST_F(IntrinsicsFactorTest, FailsWhereTheFactorFails) {
  const Block at_infinity = testing::LineBlockOf({{0, 0, 1}, {1, 0, 0}});
  Vector2d residual;
  const std::vector<Block> blocks = {at_infinity, intrinsics_};
  EXPECT_FALSE(Line(kHost).Evaluate(testing::Pointers(blocks).data(), residual.data(), nullptr));
}

}  // namespace
}  // namespace plm_vins

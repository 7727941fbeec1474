// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/intrinsics_factor.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "common/geometry/so3.h"
#include "simulator/default_sensors.h"
#include "test/vins_estimator/factors/factor_scene.h"
#include "vins_estimator/factors/line_factor.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/factors/stereo_factor.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Block;
using testing::ScalarBlock;

constexpr double kWeight = 2;

// The camera with which the rays were computed, and similar intrinsics.
class IntrinsicsFactorTest : public ::testing::Test {
 protected:
  IntrinsicsFactorTest() : identity_(Block::Zero(7)), turned_(7), intrinsics_(kIntrinsicsSize) {
    identity_[6] = 1;
    turned_ << 0.3, -0.1, 0.2, SO3Exp(Vector3d(0.05, -0.02, 0.03)).coeffs();
    intrinsics_ << 1, -2, 3, -4, 0.01, -0.01, 0.001, -0.001;
    intrinsics_ += camera_->parameters().intrinsics();
  }

  Block LineBlock() const {
    return testing::LineBlockOf(LineThrough({0.4, -0.8, 4}, {-1, 0.8, 5}));
  }

  template <typename Inner>
  PointIntrinsicsFactor<Inner> Point(const Inner& factor) const {
    return {factor, RayShift(*camera_, bearing_.xy), kWeight};
  }

  template <typename Inner>
  LineIntrinsicsFactor<Inner> Line() const {
    return {view_, kWeight, RayShift(*camera_, view_.start), RayShift(*camera_, view_.end)};
  }

  // The ray of the pixel of `xy` with other intrinsics.
  Vector2d Recalibrated(const Vector2d& xy, const Block& intrinsics) const {
    const auto other = CameraModel::Create(camera_->parameters().With(Intrinsics(intrinsics)));
    return *other->Unproject(*camera_->Project(xy.homogeneous()));
  }

  const std::unique_ptr<const CameraModel> camera_ =
      CameraModel::Create(simulator::DefaultSensors().cameras[0].parameters);
  const TimedBearing bearing_{{0.1, -0.2}, {1, 2}, 0.01};
  const LineSegmentView view_{{0.1, -0.2}, {-0.2, 0.15}};
  const Block point_ = Vector3d(0.12, -0.23, 0.5);
  Block identity_, turned_, intrinsics_;
};

TEST_F(IntrinsicsFactorTest, AtTheIntrinsicsOfTheRaysIsTheFactorItself) {
  const Block reference = camera_->parameters().intrinsics();
  const auto point = Point(PointHostFactor(bearing_, kWeight));
  EXPECT_MATRIX_NEAR(
      testing::Residual(point, {ScalarBlock(0.02), point_, reference}),
      testing::Residual(PointHostFactor(bearing_, kWeight), {ScalarBlock(0.02), point_}), 1e-12);
  const auto line = Line<LineHostFactor>();
  EXPECT_MATRIX_NEAR(testing::Residual(line, {LineBlock(), reference}),
                     testing::Residual(LineHostFactor(view_, kWeight), {LineBlock()}), 1e-12);
}

TEST_F(IntrinsicsFactorTest, KeepsPixelsWithOtherIntrinsics) {
  const Block near =
      camera_->parameters().intrinsics() + 0.1 * (intrinsics_ - camera_->parameters().intrinsics());
  TimedBearing moved_bearing = bearing_;
  moved_bearing.xy = Recalibrated(bearing_.xy, near);
  const auto point = Point(PointHostFactor(bearing_, kWeight));
  EXPECT_MATRIX_NEAR(
      testing::Residual(point, {ScalarBlock(0.02), point_, near}),
      testing::Residual(PointHostFactor(moved_bearing, kWeight), {ScalarBlock(0.02), point_}),
      1e-5);
  const LineSegmentView moved_view{Recalibrated(view_.start, near), Recalibrated(view_.end, near)};
  const auto line = Line<LineHostFactor>();
  EXPECT_MATRIX_NEAR(testing::Residual(line, {LineBlock(), near}),
                     testing::Residual(LineHostFactor(moved_view, kWeight), {LineBlock()}), 1e-5);
}

TEST_F(IntrinsicsFactorTest, HasExactJacobiansForPoints) {
  const auto host = Point(PointHostFactor(bearing_, kWeight));
  testing::ExpectTangentJacobians(host, {ScalarBlock(0.03), point_, intrinsics_}, 1e-7);
  const auto target = Point(PointFactor(bearing_, kWeight));
  testing::ExpectTangentJacobians(
      target, {identity_, turned_, identity_, ScalarBlock(0.03), point_, intrinsics_}, 1e-7);
}

TEST_F(IntrinsicsFactorTest, HasExactJacobiansForLines) {
  const auto host = Line<LineHostFactor>();
  testing::ExpectTangentJacobians(host, {LineBlock(), intrinsics_}, 1e-6);
  const auto target = Line<LineFactor>();
  testing::ExpectTangentJacobians(target, {identity_, turned_, identity_, LineBlock(), intrinsics_},
                                  1e-6);
}

TEST_F(IntrinsicsFactorTest, HasExactJacobiansInTheSecondCamera) {
  constexpr double kStep = 1e-6;
  const Block mounting = testing::PoseBlockOf({SO3Exp({0.01, 0.02, -0.03}), {0.1, 0.02, 0.01}});
  const RayShift shift(*camera_, bearing_.xy);
  const PointIntrinsicsFactor<RightPointHostFactor> point_in_host({bearing_, kWeight}, shift,
                                                                  kWeight);
  testing::ExpectTangentJacobians(point_in_host, {mounting, ScalarBlock(0.03), point_, intrinsics_},
                                  1e-7, kStep,
                                  /*mounting=*/0);
  const PointIntrinsicsFactor<RightPointFactor> point({bearing_, kWeight}, shift, kWeight);
  testing::ExpectTangentJacobians(
      point, {identity_, turned_, identity_, mounting, ScalarBlock(0.03), point_, intrinsics_},
      1e-7, kStep, /*mounting=*/3);
  const RayShift start(*camera_, view_.start), end(*camera_, view_.end);
  const LineIntrinsicsFactor<RightLineHostFactor> line_in_host(view_, {2, 3}, start, end);
  testing::ExpectTangentJacobians(line_in_host, {mounting, LineBlock(), intrinsics_}, 1e-6, kStep,
                                  /*mounting=*/0);
  const LineIntrinsicsFactor<RightLineFactor> line(view_, {2, 3}, start, end);
  testing::ExpectTangentJacobians(
      line, {identity_, turned_, identity_, mounting, LineBlock(), intrinsics_}, 1e-6, kStep,
      /*mounting=*/3);
}

TEST_F(IntrinsicsFactorTest, KeepsRaysOutsideTheFieldOfView) {
  CameraParameters folded = camera_->parameters();
  folded.distortion = {-0.4, 0, 0, 0};  // valid up to a radius of 0.91
  const RayShift shift(*CameraModel::Create(folded), Vector2d(0.9, 0.9));
  EXPECT_EQ(shift.At(intrinsics_.data()), Vector2d(0, 0));
}

TEST_F(IntrinsicsFactorTest, FailsWhereTheFactorFails) {
  const auto line = Line<LineHostFactor>();
  const Block at_infinity = testing::LineBlockOf({{0, 0, 1}, {1, 0, 0}});
  Vector2d residual;
  const std::vector<Block> blocks = {at_infinity, intrinsics_};
  EXPECT_FALSE(line.Evaluate(testing::Pointers(blocks).data(), residual.data(), nullptr));
}

}  // namespace
}  // namespace plm_vins

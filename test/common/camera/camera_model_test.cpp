// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/camera_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <ostream>
#include <stdexcept>
#include <string>

#include "simulator/default_sensors.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Model = CameraParameters::Model;
using testing::NumericJacobian;

CameraParameters Parameters(Model model, const Eigen::Vector4d& intrinsics,
                            const Eigen::Vector4d& distortion, double xi = 0) {
  CameraParameters p;
  p.model = model;
  p.width = 752;
  p.height = 480;
  p.fx = intrinsics[0];
  p.fy = intrinsics[1];
  p.cx = intrinsics[2];
  p.cy = intrinsics[3];
  p.distortion = distortion;
  p.xi = xi;
  return p;
}

CameraParameters Euroc() { return simulator::DefaultSensors().cameras[0].parameters; }

CameraParameters Fisheye() {
  return Parameters(Model::kPinholeEquidistant, {380.81, 380.79, 370.3, 247.7},
                    {0.0101, -0.0091, 0.0047, -0.00132});
}

CameraParameters Omnidirectional(double gamma, double xi) {
  return Parameters(Model::kMei, {gamma, gamma + 5, 372.0, 238.0}, {-0.05, 0.01, 0.0003, -0.0002},
                    xi);
}

struct Case {
  std::string name;
  CameraParameters parameters;
};

void PrintTo(const Case& value, std::ostream* stream) { *stream << value.name; }

class EveryModel : public ::testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<const CameraModel> camera_ = CameraModel::Create(GetParam().parameters);
};

INSTANTIATE_TEST_SUITE_P(CameraModel, EveryModel,
                         ::testing::Values(Case{"Radtan", Euroc()},
                                           Case{"KannalaBrandt", Fisheye()},
                                           Case{"MeiXi0", Omnidirectional(460, 0)},
                                           Case{"MeiXi08", Omnidirectional(750, 0.8)},
                                           Case{"MeiXi17", Omnidirectional(1300, 1.7)}),
                         [](const auto& info) { return info.param.name; });

TEST_P(EveryModel, UnprojectsEveryPixelOfTheImageAndBack) {
  for (double v = 0; v <= 479; v += 479.0 / 60) {
    for (double u = 0; u <= 751; u += 751.0 / 90) {
      const Eigen::Vector2d pixel(u, v);
      const auto xy = camera_->Unproject(pixel);
      ASSERT_TRUE(xy) << pixel.transpose();
      const auto again = camera_->Project(2.5 * xy->homogeneous());
      ASSERT_TRUE(again) << pixel.transpose();
      EXPECT_MATRIX_NEAR(*again, pixel, 1e-10);
    }
  }
}

TEST_P(EveryModel, CenterAndImageAxesPointForwardRightAndDown) {
  const auto& p = camera_->parameters();
  EXPECT_MATRIX_NEAR(*camera_->Project({0, 0, 3}), Eigen::Vector2d(p.cx, p.cy), 1e-12);
  EXPECT_MATRIX_NEAR(*camera_->Unproject({p.cx, p.cy}), Eigen::Vector2d::Zero(), 1e-15);
  EXPECT_GT(camera_->Project({0.1, 0, 1})->x(), p.cx);
  EXPECT_GT(camera_->Project({0, 0.1, 1})->y(), p.cy);
}

TEST_P(EveryModel, FocalLengthIsTheScaleAtTheCenter) {
  constexpr double kAngle = 1e-5;
  const auto& p = camera_->parameters();
  const double right = camera_->Project({std::tan(kAngle), 0, 1})->x() - p.cx;
  const double down = camera_->Project({0, std::tan(kAngle), 1})->y() - p.cy;
  EXPECT_NEAR(camera_->FocalLength(), 0.5 * (right + down) / kAngle, 1.0);
}

TEST_P(EveryModel, JacobiansMatchNumericDifferences) {
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(10, 20), Eigen::Vector2d(700, 30),
                                       Eigen::Vector2d(400, 470), Eigen::Vector2d(367, 250)}) {
    Eigen::Matrix2d d_xy_d_pixel;
    const Eigen::Vector2d xy = *camera_->Unproject(pixel, &d_xy_d_pixel);
    const auto unproject = [&](const Eigen::Vector2d& x) { return *camera_->Unproject(x); };
    EXPECT_MATRIX_NEAR(d_xy_d_pixel, NumericJacobian(unproject, pixel, 1e-3), 1e-8);

    const Eigen::Vector3d p_C = 1.7 * xy.homogeneous();
    Eigen::Matrix<double, 2, 3> d_pixel_d_point;
    ASSERT_TRUE(camera_->Project(p_C, &d_pixel_d_point));
    const auto project = [&](const Eigen::Vector3d& x) { return *camera_->Project(x); };
    EXPECT_MATRIX_NEAR(d_pixel_d_point, NumericJacobian(project, p_C, 1e-5), 1e-5);
  }
}

TEST_P(EveryModel, IntrinsicsJacobiansMatchNumericDifferences) {
  const CameraParameters& parameters = camera_->parameters();
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(10, 20), Eigen::Vector2d(700, 30),
                                       Eigen::Vector2d(400, 470), Eigen::Vector2d(367, 250)}) {
    const auto ray = [&](const Intrinsics& intrinsics) {
      return *CameraModel::Create(parameters.With(intrinsics))->Unproject(pixel);
    };
    const auto d_xy_d_intrinsics = camera_->RayByIntrinsics(*camera_->Unproject(pixel));
    ASSERT_TRUE(d_xy_d_intrinsics);
    EXPECT_MATRIX_NEAR(*d_xy_d_intrinsics, NumericJacobian(ray, parameters.intrinsics()), 1e-7);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(camera_->RayByIntrinsics({nan, 0}));
}

TEST_P(EveryModel, ChangingIntrinsicsKeepsOtherParameters) {
  const CameraParameters& parameters = camera_->parameters();
  Intrinsics intrinsics;
  intrinsics << 1, 2, 3, 4, 5, 6, 7, 8;
  const CameraParameters other = parameters.With(intrinsics);
  EXPECT_EQ(other.intrinsics(), intrinsics);
  EXPECT_EQ(other.fy, 2);
  EXPECT_EQ(other.cx, 3);
  EXPECT_EQ(other.distortion, Eigen::Vector4d(5, 6, 7, 8));
  EXPECT_EQ(other.With(parameters.intrinsics()).intrinsics(), parameters.intrinsics());
  EXPECT_EQ(other.model, parameters.model);
  EXPECT_EQ(other.height, parameters.height);
  EXPECT_EQ(other.xi, parameters.xi);
}

TEST_P(EveryModel, JacobiansAreFiniteOnTheOpticalAxis) {
  const auto& p = camera_->parameters();
  const Eigen::Vector3d p_C(0, 0, 2);
  Eigen::Matrix<double, 2, 3> d_pixel_d_point;
  ASSERT_TRUE(camera_->Project(p_C, &d_pixel_d_point));
  const auto project = [&](const Eigen::Vector3d& x) { return *camera_->Project(x); };
  EXPECT_MATRIX_NEAR(d_pixel_d_point, NumericJacobian(project, p_C, 1e-5), 1e-5);

  Eigen::Matrix2d d_xy_d_pixel;
  ASSERT_TRUE(camera_->Unproject({p.cx, p.cy}, &d_xy_d_pixel));
  EXPECT_MATRIX_NEAR(d_pixel_d_point.leftCols<2>() * 2 * d_xy_d_pixel, Eigen::Matrix2d::Identity(),
                     1e-12);
}

TEST_P(EveryModel, RejectsNonFinitePoints) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(camera_->Project({0, 0, 0}));
  EXPECT_FALSE(camera_->Project({0, 0, -1}));
  EXPECT_FALSE(camera_->Project({nan, 0, 1}));
  EXPECT_FALSE(camera_->Project({0, infinity, 1}));
  EXPECT_FALSE(camera_->Unproject({nan, 10}));
  EXPECT_FALSE(camera_->Unproject({infinity, 10}));
}

TEST_P(EveryModel, RoundTripHoldsFarOutsideTheImage) {
  for (double v = -3000; v <= 3000; v += 97) {
    for (double u = -3000; u <= 3000; u += 89) {
      const Eigen::Vector2d pixel(u, v);
      const auto xy = camera_->Unproject(pixel);
      if (!xy) continue;
      const auto again = camera_->Project(xy->homogeneous());
      ASSERT_TRUE(again) << pixel.transpose();
      EXPECT_MATRIX_NEAR(*again, pixel, 1e-6);
    }
  }
}

cv::Matx33d CameraMatrix(const CameraParameters& p) {
  return {p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1};
}

cv::Vec4d Distortion(const CameraParameters& p) {
  return {p.distortion[0], p.distortion[1], p.distortion[2], p.distortion[3]};
}

TEST(PinholeRadtan, AgreesWithOpenCV) {
  const auto camera = CameraModel::Create(Euroc());
  const std::vector<cv::Point3d> points = {{0.3, -0.2, 1}, {-1.1, 0.7, 1.6}, {2, 1.4, 3}};
  std::vector<cv::Point2d> pixels, rays;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), CameraMatrix(Euroc()), Distortion(Euroc()),
                    pixels);
  cv::undistortPoints(pixels, rays, CameraMatrix(Euroc()), Distortion(Euroc()), cv::noArray(),
                      cv::noArray(), cv::TermCriteria(cv::TermCriteria::COUNT, 500, 0));
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d expected(pixels[i].x, pixels[i].y);
    EXPECT_MATRIX_NEAR(*camera->Project({points[i].x, points[i].y, points[i].z}), expected, 1e-10);
    EXPECT_MATRIX_NEAR(*camera->Unproject(expected), Eigen::Vector2d(rays[i].x, rays[i].y), 1e-9);
  }
}

TEST(PinholeRadtan, RejectsTheFoldOfItsDistortion) {
  // r (1 - 0.4 r^2) increases up to r = sqrt(1 / 1.2) = 0.913, where it is 0.609.
  const auto camera =
      CameraModel::Create(Parameters(Model::kPinholeRadtan, {400, 400, 0, 0}, {-0.4, 0, 0, 0}));
  EXPECT_TRUE(camera->Project({0.91, 0, 1}));
  EXPECT_FALSE(camera->Project({0.92, 0, 1}));
  EXPECT_FALSE(camera->Project({0, -1.5, 1}));
  EXPECT_TRUE(camera->Unproject({400 * 0.608, 0}));
  EXPECT_FALSE(camera->Unproject({400 * 0.61, 0}));
  EXPECT_FALSE(camera->Unproject({-300, 300}));
}

TEST(PinholeRadtan, TakesTheInnerOfTwoFolds) {
  // 1 - 3 s + 2 s^2 (s = r^2) is zero at s = 0.5 and s = 1.
  const auto camera =
      CameraModel::Create(Parameters(Model::kPinholeRadtan, {1, 1, 0, 0}, {-1.0, 0.4, 0, 0}));
  EXPECT_TRUE(camera->Project({std::sqrt(0.499), 0, 1}));
  EXPECT_FALSE(camera->Project({std::sqrt(0.501), 0, 1}));
  EXPECT_FALSE(camera->Project({2.0, 0, 1}));
}

TEST(PinholeRadtan, PincushionDistortionReachesEverywhere) {
  const auto camera =
      CameraModel::Create(Parameters(Model::kPinholeRadtan, {400, 400, 0, 0}, {0.4, 0.3, 0, 0}));
  for (const double radius : {0.1, 1.0, 10.0, 100.0}) {
    const auto pixel = camera->Project({radius, radius, 1});
    ASSERT_TRUE(pixel);
    const auto xy = camera->Unproject(*pixel);
    ASSERT_TRUE(xy) << radius;
    EXPECT_NEAR(xy->x() / radius, 1, 1e-12);
  }
}

TEST(KannalaBrandt, AgreesWithOpenCV) {
  const auto camera = CameraModel::Create(Fisheye());
  const std::vector<cv::Point3d> points = {{0.3, -0.2, 1}, {-1.1, 0.7, 0.8}, {2, 1.4, 1}};
  std::vector<cv::Point2d> pixels, rays;
  cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), CameraMatrix(Fisheye()),
                             Distortion(Fisheye()));
  cv::fisheye::undistortPoints(pixels, rays, CameraMatrix(Fisheye()), Distortion(Fisheye()));
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d expected(pixels[i].x, pixels[i].y);
    EXPECT_MATRIX_NEAR(*camera->Project({points[i].x, points[i].y, points[i].z}), expected, 1e-10);
    EXPECT_MATRIX_NEAR(*camera->Unproject(expected), Eigen::Vector2d(rays[i].x, rays[i].y), 1e-6);
  }
}

TEST(KannalaBrandt, RaysBehindTheCameraHaveNoNormalizedPoint) {
  const auto camera = CameraModel::Create(
      Parameters(Model::kPinholeEquidistant, {200, 200, 0, 0}, Eigen::Vector4d::Zero()));
  const auto pixel = camera->Project({1, 0, -1});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 200 * 3 * M_PI / 4, 1e-10);
  EXPECT_FALSE(camera->Unproject(*pixel));
}

TEST(KannalaBrandt, RejectsTheFoldOfItsDistortion) {
  // theta (1 - theta^2 / 3) increases up to theta = 1, where it is 2/3.
  const auto camera = CameraModel::Create(
      Parameters(Model::kPinholeEquidistant, {300, 300, 0, 0}, {-1.0 / 3, 0, 0, 0}));
  EXPECT_TRUE(camera->Project({std::sin(0.999), 0, std::cos(0.999)}));
  EXPECT_FALSE(camera->Project({std::sin(1.001), 0, std::cos(1.001)}));
  EXPECT_NEAR(camera->Unproject({300 * 0.66666, 0})->x(), std::tan(1.0), 0.02);
  EXPECT_FALSE(camera->Unproject({300 * 0.6667, 0}));
}

TEST(Mei, WithoutMirrorIsThePinhole) {
  CameraParameters parameters = Euroc();
  const auto pinhole = CameraModel::Create(parameters);
  parameters.model = Model::kMei;
  const auto mei = CameraModel::Create(parameters);
  const Eigen::Vector3d p_C(-0.4, 0.3, 1.2);
  EXPECT_MATRIX_NEAR(*mei->Project(p_C), *pinhole->Project(p_C), 1e-12);
  EXPECT_EQ(mei->FocalLength(), pinhole->FocalLength());
}

TEST(Mei, ProjectsFromTheSphere) {
  const auto camera =
      CameraModel::Create(Parameters(Model::kMei, {100, 100, 0, 0}, Eigen::Vector4d::Zero(), 0.5));
  // (3, 0, 4) is projected to (0.6, 0, 0.8) on the sphere: 0.6 / (0.8 + 0.5).
  EXPECT_NEAR(camera->Project({3, 0, 4})->x(), 100 * 0.6 / 1.3, 1e-12);
  // A ray at 90 degrees can be projected, but has no normalized image point.
  const auto sideways = camera->Project({1, 0, 0});
  ASSERT_TRUE(sideways);
  EXPECT_FALSE(camera->Unproject(*sideways));
  EXPECT_FALSE(camera->Project({1, 0, -1}));  // cosine -0.71 < -0.5
}

TEST(CameraModel, IsInImageKeepsTheBorder) {
  const auto camera = CameraModel::Create(Euroc());
  EXPECT_TRUE(camera->IsInImage({0, 0}));
  EXPECT_TRUE(camera->IsInImage({751, 479}));
  EXPECT_FALSE(camera->IsInImage({751.1, 100}));
  EXPECT_FALSE(camera->IsInImage({-0.1, 100}));
  EXPECT_FALSE(camera->IsInImage({4, 100}, 5));
  EXPECT_TRUE(camera->IsInImage({5, 100}, 5));
}

TEST(CameraModel, CreateRejectsBadParameters) {
  const auto refuses = [](auto change) {
    CameraParameters parameters = Euroc();
    change(parameters);
    EXPECT_THROW(CameraModel::Create(parameters), std::invalid_argument);
  };
  refuses([](CameraParameters& p) { p.fx = 0; });
  refuses([](CameraParameters& p) { p.fy = -400; });
  refuses([](CameraParameters& p) { p.cx = std::nan(""); });
  refuses([](CameraParameters& p) { p.distortion[2] = INFINITY; });
  refuses([](CameraParameters& p) { p.xi = std::nan(""); });
  refuses([](CameraParameters& p) { p.xi = -0.1; });
}

}  // namespace
}  // namespace plm_vins

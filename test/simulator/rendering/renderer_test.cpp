// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/geometry/so3.h"
#include "simulator/default_sensors.h"

namespace plm_vins::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

int AddPlain(Scene* scene, double brightness) {
  return scene->AddTexture(cv::Mat1b(4, 4, cv::saturate_cast<uchar>(255 * brightness)), 1, 1);
}

// A rectangle that faces a camera looking along +z of W with y down.
Rectangle Facing(double left, double bottom, double depth, double width, double height,
                 int texture) {
  return {{left, bottom, depth}, Vector3d::UnitX(), -Vector3d::UnitY(), width, height, texture};
}

cv::Mat1f Render(const Renderer& renderer, const CameraParameters& camera, const Rigid3d& T_W_C) {
  cv::Mat1f sum(camera.height, camera.width, 0.0f);
  for (int i = 0; i < Renderer::kSubpixels; ++i) renderer.Accumulate(T_W_C, i, &sum);
  return sum / Renderer::kSubpixels;
}

// The common corner of two white squares on a black wall.
struct SaddleScene {
  Scene scene;
  std::vector<Vector3d> saddles;

  SaddleScene() {
    const int black = AddPlain(&scene, 0.1), white = AddPlain(&scene, 0.9);
    scene.AddRectangle(Facing(-8, 8, 3.0, 16, 16, black));
    for (double x : {-2.1, -1.05, 0.0, 1.05, 2.1}) {
      for (double y : {-1.2, 0.0, 1.2}) {
        const double size = 0.45, depth = 2.99;
        scene.AddRectangle(Facing(x - size, y, depth, size, size, white));
        scene.AddRectangle(Facing(x, y + size, depth, size, size, white));
        saddles.push_back({x, y, depth});
      }
    }
  }
};

CameraParameters Fisheye() {
  CameraParameters camera = DefaultSensors().cameras[0].parameters;
  camera.model = CameraParameters::Model::kPinholeEquidistant;
  camera.fx = camera.fy = 300;
  camera.distortion = {-0.01, 0.02, -0.01, 0.002};
  return camera;
}

// A wall at z = 3 with a square at z = 2 before its middle.
TEST(Renderer, DepthIsThatOfTheRayThroughThePixel) {
  Scene scene;
  const int white = AddPlain(&scene, 0.9);
  scene.AddRectangle(Facing(-2, 8, 3.0, 10, 16, white));
  scene.AddRectangle(Facing(-0.5, 0.5, 2.0, 1, 1, white));
  for (const CameraParameters& parameters : {DefaultSensors().cameras[0].parameters, Fisheye()}) {
    const std::shared_ptr<const CameraModel> camera = CameraModel::Create(parameters);
    const Rigid3d T_W_C(SO3Exp({0.2, -0.25, 0.4}), {0.1, -0.05, 0.2});
    const cv::Mat1f depth = Renderer(scene, camera).Depth(T_W_C);
    std::array<int, 3> counts{};
    for (int y = 0; y < depth.rows; y += 3) {
      for (int x = 0; x < depth.cols; x += 3) {
        const auto xy = camera->Unproject({x, y});
        if (!xy) continue;
        const Vector3d ray_W = T_W_C.rotation * xy->homogeneous();
        if (ray_W.z() < 0.05) continue;  // parallel to the wall, or away from it
        const auto depth_at = [&](double z) { return (z - T_W_C.translation.z()) / ray_W.z(); };
        const auto point_at = [&](double z) -> Vector3d {
          return T_W_C.translation + depth_at(z) * ray_W;
        };
        const Vector3d on_square = point_at(2), on_wall = point_at(3) - Vector3d(3, 0, 0);
        const double beside_square = on_square.head<2>().cwiseAbs().maxCoeff() - 0.5;
        const double beside_wall = std::max(std::abs(on_wall.x()) - 5, std::abs(on_wall.y()) - 8);
        if (std::abs(beside_square) < 1e-2 || std::abs(beside_wall) < 1e-2) continue;
        const int surface = beside_square < 0 ? 2 : beside_wall < 0 ? 1 : 0;
        const double expected = surface == 2 ? depth_at(2) : surface == 1 ? depth_at(3) : 0.0;
        ASSERT_NEAR(depth(y, x), expected, 1e-4 * (1 + expected)) << x << " " << y;
        ++counts[surface];
      }
    }
    for (const int count : counts) EXPECT_GT(count, 500);
  }
}

TEST(Renderer, KnownPointsAppearWhereTheCameraModelProjectsThem) {
  const SaddleScene world;
  Vector2d bias = Vector2d::Zero();
  int total = 0;
  for (const CameraParameters& parameters : {DefaultSensors().cameras[0].parameters, Fisheye()}) {
    const std::shared_ptr<const CameraModel> camera = CameraModel::Create(parameters);
    const Renderer renderer(world.scene, camera);
    for (const Vector3d& tilt : {Vector3d(0, 0, 0), Vector3d(0.2, -0.25, 0.4)}) {
      const Rigid3d T_W_C(SO3Exp(tilt), {0.1, -0.05, 0.2});
      // cornerSubPix itself is off by 0.1 px if edges are sharper than those of a lens.
      cv::Mat1f image = Render(renderer, parameters, T_W_C);
      cv::GaussianBlur(image, image, {9, 9}, 1.5);
      int checked = 0;
      for (const Vector3d& saddle : world.saddles) {
        const auto pixel = camera->Project(T_W_C.Inverse() * saddle);
        if (!pixel || !camera->IsInImage(*pixel, 15)) continue;
        std::vector<cv::Point2f> corner{{float(pixel->x() + 0.8), float(pixel->y() - 0.6)}};
        cv::cornerSubPix(image, corner, {9, 9}, {-1, -1}, {cv::TermCriteria::EPS, 100, 1e-4});
        const Vector2d error = Vector2d(corner[0].x, corner[0].y) - *pixel;
        EXPECT_LT(error.norm(), 0.1) << pixel->transpose();
        bias += error;
        ++checked;
      }
      EXPECT_GE(checked, 5);
      total += checked;
    }
  }
  EXPECT_LT((bias / total).norm(), 0.02);
}

TEST(Renderer, NearObjectsHideFarOnesAndBacksAreInvisible) {
  Scene scene;
  const int dark = AddPlain(&scene, 0.2), bright = AddPlain(&scene, 0.8);
  scene.AddRectangle(Facing(-0.2, 0.2, 2.0, 0.4, 0.4, bright));
  scene.AddRectangle(Facing(-9, 9, 3.0, 18, 18, dark));
  scene.AddRectangle({{-9, 9, 1.0}, Vector3d::UnitY(), Vector3d::UnitX(), 18, 18, bright});
  const CameraParameters parameters = DefaultSensors().cameras[0].parameters;
  const Renderer renderer(scene, CameraModel::Create(parameters));
  const cv::Mat1f image = Render(renderer, parameters, Rigid3d());
  const double dark_value = image(20, 20);
  EXPECT_NEAR(image(248, 367), 4 * dark_value, 0.05 * dark_value);
  EXPECT_NEAR(image(400, 600), dark_value, 1e-6);
}

TEST(Renderer, BoxesShowAFaceToEverySide) {
  Scene scene;
  scene.AddBox(Rigid3d(), {1, 0.8, 0.6}, AddPlain(&scene, 0.9));
  const CameraParameters parameters = DefaultSensors().cameras[0].parameters;
  const Renderer renderer(scene, CameraModel::Create(parameters));
  for (int axis = 0; axis < 3; ++axis) {
    for (double side : {-1.0, 1.0}) {
      const Vector3d outwards = side * Vector3d::Unit(axis);
      const Rigid3d T_W_C(ShortestRotation(Vector3d::UnitZ(), -outwards), 3.0 * outwards);
      const cv::Mat1f image = Render(renderer, parameters, T_W_C);
      EXPECT_GT(image(248, 367), 0.2) << "from " << outwards.transpose();
      EXPECT_EQ(image(5, 5), 0.0f);
    }
  }
}

TEST(Renderer, PipesHaveTheirWidth) {
  Scene scene;
  scene.AddPipe({0, -2, 2}, {0, 2, 2}, 0.1, AddPlain(&scene, 0.9));
  CameraParameters parameters = DefaultSensors().cameras[0].parameters;
  parameters.distortion.setZero();
  const Renderer renderer(scene, CameraModel::Create(parameters));
  const cv::Mat1f image = Render(renderer, parameters, Rigid3d());
  const int width = cv::countNonZero(image.row(240) > 0.1f);
  EXPECT_NEAR(width, 2 * 0.1 / 2 * parameters.fx, 2.0);
}

}  // namespace
}  // namespace plm_vins::simulator

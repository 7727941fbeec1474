// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/scene.h"

#include <cmath>

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

// Light on a surface by its normal: a diffuse sky from above and a distant lamp.
double LightOn(const Vector3d& normal) {
  const Vector3d towards_lamp = Vector3d(0.45, 0.25, 0.6).normalized();
  return 0.72 + 0.08 * normal.z() + 0.22 * normal.dot(towards_lamp);
}

// Pseudo-random texture offset, so that objects with a shared texture look different.
double Scatter(double coordinate) { return 7.31 * coordinate - std::floor(7.31 * coordinate); }

}  // namespace

int Scene::AddTexture(const cv::Mat& image, double width, double height) {
  textures_.emplace_back(image, width, height);
  return static_cast<int>(textures_.size()) - 1;
}

void Scene::AddRectangle(Rectangle rectangle) {
  rectangle.gain += LightOn(rectangle.Normal());
  rectangles_.push_back(rectangle);
}

void Scene::AddBox(const Rigid3d& T_W_O, const Vector3d& size, int texture) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      // For vertical faces, v points up.
      const int v_axis = axis == 2 ? 1 : 2, u_axis = 3 - axis - v_axis;
      Vector3d normal = side * Vector3d::Unit(axis), v = Vector3d::Unit(v_axis),
               u = v.cross(normal);
      const double width = size[u_axis], height = size[v_axis];
      const Vector3d corner = 0.5 * size[axis] * normal - 0.5 * width * u - 0.5 * height * v;
      Rectangle face{T_W_O * corner, T_W_O.rotation * u, T_W_O.rotation * v, width, height,
                     texture};
      face.texture_u = Scatter(face.corner.x() + face.corner.z());
      face.texture_v = Scatter(face.corner.y() - face.corner.z());
      AddRectangle(face);
    }
  }
}

void Scene::AddPipe(const Vector3d& start, const Vector3d& end, double radius, int texture) {
  constexpr int kFacets = 12;
  const Vector3d v = (end - start).normalized(), side = v.unitOrthogonal(), other = v.cross(side);
  const double facet_width = 2.0 * radius * std::sin(M_PI / kFacets);
  const double inner_radius = radius * std::cos(M_PI / kFacets);
  for (int i = 0; i < kFacets; ++i) {
    const double angle = 2.0 * M_PI * i / kFacets;
    const Vector3d normal = std::cos(angle) * side + std::sin(angle) * other, u = v.cross(normal);
    const Vector3d corner = start + inner_radius * normal - 0.5 * facet_width * u;
    AddRectangle({corner, u, v, facet_width, (end - start).norm(), texture, i * facet_width});
  }
}

void Scene::Repeat(const Vector3d& offset) {
  const size_t count = rectangles_.size();
  for (size_t i = 0; i < count; ++i) {
    Rectangle copy = rectangles_[i];
    copy.corner += offset;
    rectangles_.push_back(copy);
  }
}

}  // namespace plm_vins::simulator

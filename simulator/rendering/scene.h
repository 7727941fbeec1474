// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry/rigid3.h"
#include "simulator/rendering/mip_texture.h"

namespace plm_vins::simulator {

// A textured rectangle of W, seen from the side of u x v only.
struct Rectangle {
  Eigen::Vector3d corner;               // lower left, seen from the front [m]
  Eigen::Vector3d u, v;                 // unit vectors to the right and upwards
  double width, height;                 // along u and v [m]
  int texture;                          // index into Scene::textures()
  double texture_u = 0, texture_v = 0;  // where in the texture the corner lies [m]
  double gain = 0;  // light of its own, to which the scene adds what falls on it

  Eigen::Vector3d Normal() const { return u.cross(v); }
  Eigen::Vector3d At(double a, double b) const { return corner + a * u + b * v; }
};

// All that the camera sees: textured rectangles, lit from a fixed direction. Everything else is
// made of them. Lengths in metres, coordinates of W unless a frame is given.
class Scene {
 public:
  int AddTexture(const cv::Mat& image, double width, double height);
  void AddRectangle(Rectangle rectangle);
  // Centred at the origin of its frame O.
  void AddBox(const Rigid3d& T_W_O, const Eigen::Vector3d& size, int texture);
  // A prism that passes for a cylinder, without end caps.
  void AddPipe(const Eigen::Vector3d& start, const Eigen::Vector3d& end, double radius,
               int texture);

  // Adds all that is there once more, moved.
  void Repeat(const Eigen::Vector3d& offset);

  const std::vector<Rectangle>& rectangles() const { return rectangles_; }
  const std::vector<MipTexture>& textures() const { return textures_; }

 private:
  std::vector<Rectangle> rectangles_;
  std::vector<MipTexture> textures_;
};

}  // namespace plm_vins::simulator

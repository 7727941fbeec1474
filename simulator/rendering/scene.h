// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry/rigid3.h"
#include "simulator/rendering/mip_texture.h"

namespace plm_vins::simulator {

// A textured rectangle in W, visible only from the side of u x v.
struct Rectangle {
  Eigen::Vector3d corner;               // lower left, as seen from the front [m]
  Eigen::Vector3d u, v;                 // unit vectors to the right and upwards
  double width, height;                 // along u and v [m]
  int texture;                          // index into Scene::textures()
  double texture_u = 0, texture_v = 0;  // texture coordinates of the corner [m]
  double gain = 0;                      // own light, to which the scene adds the incident light

  Eigen::Vector3d Normal() const { return u.cross(v); }
  Eigen::Vector3d At(double a, double b) const { return corner + a * u + b * v; }
};

// Everything that the camera can see, composed of textured rectangles and lit from a fixed
// direction. Lengths in meters, coordinates in W unless a frame is given.
class Scene {
 public:
  int AddTexture(const cv::Mat& image, double width, double height);
  void AddRectangle(Rectangle rectangle);
  // Adds a box, centered at the origin of its frame O.
  void AddBox(const Rigid3d& T_W_O, const Eigen::Vector3d& size, int texture);
  // Adds a prism that approximates a cylinder, without end caps.
  void AddPipe(const Eigen::Vector3d& start, const Eigen::Vector3d& end, double radius,
               int texture);

  // Adds a translated copy of everything added so far.
  void Repeat(const Eigen::Vector3d& offset);

  const std::vector<Rectangle>& rectangles() const { return rectangles_; }
  const std::vector<MipTexture>& textures() const { return textures_; }

 private:
  std::vector<Rectangle> rectangles_;
  std::vector<MipTexture> textures_;
};

}  // namespace plm_vins::simulator

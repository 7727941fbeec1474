// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/geometry/rigid3.h"
#include "simulator/rendering/scene.h"
#include "simulator/rendering/texture_painter.h"

namespace plm_vins::simulator {

enum class TextureStyle { kRich, kWeak };

// A wall with its own frame F: origin in the lower left corner as seen from the room, x to the
// right, y upwards, z into the room.
struct Wall {
  Rigid3d T_W_F;
  double width, height;  // [m]
};

// Texture indices of materials that objects of a scene share.
struct Materials {
  int wood, dark_wood, metal, white, black, cardboard;
};

// Adds objects to a scene. Positions on walls are in the wall's frame [m].
class Furnisher {
 public:
  // `texel` is the size of the finest detail on the walls [m].
  Furnisher(Scene* scene, TextureStyle style, double texel, uint64_t seed);

  enum class Surface {
    kPlaster,
    kBricks,
    kTiles,
    kPanels,
    kOpen  // no wall
  };

  // Adds the inner faces of a room with vertical walls and its floor at z = 0. `corners` are those
  // of the floor, counterclockwise [m]; wall i extends from corner i to the next one.
  std::vector<Wall> AddRoom(const std::vector<Eigen::Vector2d>& corners, double height,
                            const std::vector<Surface>& walls, Surface floor, Surface ceiling);

  // Adds a wall above an edge of the floor, which is on the left when walking from `from` to `to`.
  Wall AddWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height,
               Surface surface);

  void AddBoxOnWall(const Wall& wall, const Eigen::Vector3d& corner, const Eigen::Vector3d& size,
                    int texture);
  void AddFrame(const Wall& wall, double x, double y, double width, double height, int texture);
  void AddDoor(const Wall& wall, double x);
  void AddWindow(const Wall& wall, double x, double y, double width, double height);
  // `tilt` is a rotation about the wall's normal [rad].
  void AddPoster(const Wall& wall, double x, double y, double width, double height, double tilt);
  void AddShelf(const Wall& wall, double x, double width, double height);
  void AddPipe(const Wall& wall, const Eigen::Vector3d& start, const Eigen::Vector3d& end,
               double radius);
  void AddSkirting(const Wall& wall);
  void AddLamp(const Eigen::Vector3d& center, double length, double yaw);

  void AddTable(const Eigen::Vector3d& floor_center, double yaw);
  void AddCrate(const Eigen::Vector3d& floor_center, double size, double yaw);
  // Adds a plank that leans against something.
  void AddPlank(const Eigen::Vector3d& foot, const Eigen::Vector3d& head, double width);

  Random& random() { return random_; }

 private:
  int Paint(Surface surface, double width, double height, double brightness);
  void AddPicture(const Wall& wall, const Eigen::Vector3d& center, double width, double height,
                  double tilt, int texture, double glow = 0);

  Scene* scene_;
  bool rich_;
  Random random_;
  TexturePainter walls_, objects_;
  Materials materials_;
};

}  // namespace plm_vins::simulator

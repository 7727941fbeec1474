// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/furnisher.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry/so3.h"

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

constexpr double kObjectTexel = 0.0025;  // [m]
constexpr double kMaterialSize = 2.0;    // side of the shared textures [m]
constexpr double kTile = 0.5;            // [m]
constexpr double kGap = 0.004;           // between a picture and its wall [m]

double Detail(TextureStyle style) { return style == TextureStyle::kRich ? 1.0 : 0.06; }

Rigid3d Upright(const Vector3d& origin, double yaw) { return {SO3Exp({0, 0, yaw}), origin}; }

Wall MakeWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height) {
  const Eigen::Vector2d along = (to - from).normalized();
  Eigen::Matrix3d R_W_F;
  R_W_F.col(0) << -along, 0;
  R_W_F.col(1) = Vector3d::UnitZ();
  R_W_F.col(2) = R_W_F.col(0).cross(R_W_F.col(1));
  return {{Eigen::Quaterniond(R_W_F), {to.x(), to.y(), 0}}, (to - from).norm(), height};
}

}  // namespace

Furnisher::Furnisher(Scene* scene, TextureStyle style, double texel, uint64_t seed)
    : scene_(scene),
      rich_(style == TextureStyle::kRich),
      random_(seed, 0),
      walls_(texel, Detail(style), seed * 3 + 1),
      objects_(kObjectTexel, Detail(style), seed * 3 + 2) {
  const double s = kMaterialSize;
  materials_.wood = scene_->AddTexture(objects_.Wood(s, s, 0.6), s, s);
  materials_.dark_wood = scene_->AddTexture(objects_.Wood(s, s, 0.32), s, s);
  materials_.metal = scene_->AddTexture(objects_.Plaster(s, s, 0.5), s, s);
  materials_.white = scene_->AddTexture(objects_.Plain(s, s, 0.9), s, s);
  materials_.black = scene_->AddTexture(objects_.Plain(s, s, 0.12), s, s);
  materials_.cardboard = scene_->AddTexture(objects_.Plaster(s, s, 0.55), s, s);
}

int Furnisher::Paint(Surface surface, double width, double height, double brightness) {
  switch (surface) {
    case Surface::kBricks:
      return scene_->AddTexture(walls_.Bricks(width, height, brightness), width, height);
    case Surface::kTiles:
      return scene_->AddTexture(walls_.Tiles(width, height, brightness, kTile), width, height);
    case Surface::kPanels:
      return scene_->AddTexture(walls_.Panels(width, height, brightness, 1.2), width, height);
    default:
      return scene_->AddTexture(walls_.Plaster(width, height, brightness), width, height);
  }
}

std::vector<Wall> Furnisher::AddRoom(const std::vector<Eigen::Vector2d>& corners, double height,
                                     const std::vector<Surface>& surfaces, Surface floor,
                                     Surface ceiling) {
  std::vector<Wall> walls;
  Eigen::AlignedBox2d box;
  for (size_t i = 0; i < corners.size(); ++i) {
    walls.push_back(AddWall(corners[i], corners[(i + 1) % corners.size()], height,
                            surfaces[i % surfaces.size()]));
    box.extend(corners[i]);
  }
  // Parts outside the room are hidden by the walls.
  const Eigen::Vector2d low = box.min(), high = box.max(), size = box.sizes();
  scene_->AddRectangle({{low.x(), low.y(), 0},
                        Vector3d::UnitX(),
                        Vector3d::UnitY(),
                        size.x(),
                        size.y(),
                        Paint(floor, size.x(), size.y(), 0.42)});
  scene_->AddRectangle({{low.x(), high.y(), height},
                        Vector3d::UnitX(),
                        -Vector3d::UnitY(),
                        size.x(),
                        size.y(),
                        Paint(ceiling, size.x(), size.y(), 0.95)});
  return walls;
}

Wall Furnisher::AddWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height,
                        Surface surface) {
  Wall wall = MakeWall(from, to, height);
  if (surface == Surface::kOpen) return wall;
  scene_->AddRectangle({wall.T_W_F.translation, wall.T_W_F.rotation * Vector3d::UnitX(),
                        Vector3d::UnitZ(), wall.width, wall.height,
                        Paint(surface, wall.width, wall.height, 0.66)});
  AddSkirting(wall);
  return wall;
}

void Furnisher::AddBoxOnWall(const Wall& wall, const Vector3d& corner, const Vector3d& size,
                             int texture) {
  // The z axis points upwards in the frame of a box, and y in that of a wall.
  Eigen::Matrix3d R_F_O;
  R_F_O << 1, 0, 0,  //
      0, 0, 1,       //
      0, -1, 0;
  const Rigid3d T_F_O(Eigen::Quaterniond(R_F_O), corner + 0.5 * size);
  scene_->AddBox(wall.T_W_F * T_F_O, {size.x(), size.z(), size.y()}, texture);
}

void Furnisher::AddFrame(const Wall& wall, double x, double y, double width, double height,
                         int texture) {
  constexpr double kBar = 0.08, kDepth = 0.06;
  AddBoxOnWall(wall, {x - kBar, y, 0}, {kBar, height, kDepth}, texture);
  AddBoxOnWall(wall, {x + width, y, 0}, {kBar, height, kDepth}, texture);
  AddBoxOnWall(wall, {x - kBar, y + height, 0}, {width + 2 * kBar, kBar, kDepth}, texture);
  if (y > 0) {
    AddBoxOnWall(wall, {x - kBar, y - kBar, 0}, {width + 2 * kBar, kBar, 2 * kDepth}, texture);
  }
}

void Furnisher::AddDoor(const Wall& wall, double x) {
  constexpr double kWidth = 0.95, kHeight = 2.05, kLeaf = 0.02, kPanel = 0.035;
  AddFrame(wall, x, 0, kWidth, kHeight, materials_.white);
  AddBoxOnWall(wall, {x, 0, 0}, {kWidth, kHeight, kLeaf}, materials_.dark_wood);
  for (const double y : {0.2, 1.15}) {
    AddBoxOnWall(wall, {x + 0.15, y, 0}, {kWidth - 0.3, 0.75, kPanel}, materials_.wood);
  }
  AddBoxOnWall(wall, {x + 0.05, 1.02, kLeaf}, {0.14, 0.03, 0.05}, materials_.white);
}

void Furnisher::AddWindow(const Wall& wall, double x, double y, double width, double height) {
  AddFrame(wall, x, y, width, height, materials_.white);
  const int view = scene_->AddTexture(objects_.View(width, height), width, height);
  AddPicture(wall, {x + 0.5 * width, y + 0.5 * height, kGap}, width, height, 0, view, 0.35);
  constexpr double kBar = 0.05;
  AddBoxOnWall(wall, {x + 0.5 * (width - kBar), y, 0}, {kBar, height, kBar}, materials_.white);
  AddBoxOnWall(wall, {x, y + 0.6 * height, 0}, {width, kBar, kBar}, materials_.white);
}

void Furnisher::AddPicture(const Wall& wall, const Vector3d& center, double width, double height,
                           double tilt, int texture, double glow) {
  const Rigid3d T_W_P = wall.T_W_F * Rigid3d(SO3Exp({0, 0, tilt}), center);
  const Vector3d corner = T_W_P * Vector3d(-0.5 * width, -0.5 * height, 0);
  scene_->AddRectangle({corner, T_W_P.rotation * Vector3d::UnitX(),
                        T_W_P.rotation * Vector3d::UnitY(), width, height, texture, 0, 0, glow});
}

void Furnisher::AddPoster(const Wall& wall, double x, double y, double width, double height,
                          double tilt) {
  const int print = scene_->AddTexture(objects_.Poster(width, height), width, height);
  AddPicture(wall, {x + 0.5 * width, y + 0.5 * height, 2 * kGap}, width, height, tilt, print);
}

void Furnisher::AddShelf(const Wall& wall, double x, double width, double height) {
  constexpr double kDepth = 0.35, kBoard = 0.03, kBack = 0.01, kStep = 0.4;
  const int wood = materials_.wood;
  AddBoxOnWall(wall, {x, 0, 0}, {width, height, kBack}, materials_.dark_wood);
  AddBoxOnWall(wall, {x - kBoard, 0, 0}, {kBoard, height, kDepth}, wood);
  AddBoxOnWall(wall, {x + width, 0, 0}, {kBoard, height, kDepth}, wood);
  for (double y = 0.08; y < height; y += kStep) {
    AddBoxOnWall(wall, {x, y, 0}, {width, kBoard, kDepth}, wood);
    const double room = std::min(kStep, height - y) - 0.12;
    if (!rich_ || room < 0.15) continue;
    const double row_width = width * random_.Uniform(0.5, 1.0);
    const int books = scene_->AddTexture(objects_.Books(row_width, room), row_width, room);
    AddPicture(wall, {x + 0.5 * row_width, y + kBoard + 0.5 * room, random_.Uniform(0.2, 0.3)},
               row_width, room, 0, books);
  }
  AddBoxOnWall(wall, {x - kBoard, height, 0}, {width + 2 * kBoard, kBoard, kDepth}, wood);
}

void Furnisher::AddPipe(const Wall& wall, const Vector3d& start, const Vector3d& end,
                        double radius) {
  scene_->AddPipe(wall.T_W_F * start, wall.T_W_F * end, radius, materials_.metal);
}

void Furnisher::AddSkirting(const Wall& wall) {
  AddBoxOnWall(wall, {0, 0, 0}, {wall.width, 0.1, 0.015}, materials_.dark_wood);
}

void Furnisher::AddLamp(const Vector3d& center, double length, double yaw) {
  constexpr double kWidth = 0.25, kHeight = 0.08, kRim = 0.02;
  const Rigid3d T_W_L = Upright(center, yaw);
  scene_->AddBox(T_W_L, {length, kWidth, kHeight}, materials_.metal);
  const Vector3d corner(-0.5 * length + kRim, 0.5 * kWidth - kRim, -0.5 * kHeight - kGap);
  scene_->AddRectangle({T_W_L * corner, T_W_L.rotation * Vector3d::UnitX(),
                        -(T_W_L.rotation * Vector3d::UnitY()), length - 2 * kRim, kWidth - 2 * kRim,
                        materials_.white, 0, 0, 0.8});
}

void Furnisher::AddTable(const Vector3d& floor_center, double yaw) {
  constexpr double kLength = 1.5, kWidth = 0.8, kHeight = 0.74, kTop = 0.04, kLeg = 0.06;
  const Rigid3d T_W_T = Upright(floor_center, yaw);
  const auto add = [&](const Vector3d& center, const Vector3d& size, int texture) {
    scene_->AddBox(T_W_T * Rigid3d(Eigen::Quaterniond::Identity(), center), size, texture);
  };
  add({0, 0, kHeight - 0.5 * kTop}, {kLength, kWidth, kTop}, materials_.wood);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      add({x * (kLength - 0.1), y * (kWidth - 0.1), 0.5 * (kHeight - kTop)},
          {kLeg, kLeg, kHeight - kTop}, materials_.dark_wood);
    }
  }
  add({0.3, 0.1, kHeight + 0.15}, {0.4, 0.25, 0.3}, materials_.cardboard);
  add({-0.35, -0.1, kHeight + 0.2}, {0.5, 0.04, 0.32}, materials_.black);
}

void Furnisher::AddCrate(const Vector3d& floor_center, double size, double yaw) {
  const Rigid3d T_W_O = Upright(floor_center + Vector3d(0, 0, 0.5 * size), yaw);
  scene_->AddBox(T_W_O, Vector3d::Constant(size), materials_.wood);
  // Planks protrude along the edges of the sides.
  const double plank = 0.12 * size, proud = size + 0.04;
  for (const double z : {-0.5, 0.5}) {
    const Vector3d center(0, 0, z * (size - plank) * 1.001);
    scene_->AddBox(T_W_O * Rigid3d(Eigen::Quaterniond::Identity(), center), {proud, proud, plank},
                   materials_.dark_wood);
  }
}

void Furnisher::AddPlank(const Vector3d& foot, const Vector3d& head, double width) {
  const Vector3d along = head - foot;
  const Rigid3d T_W_O(ShortestRotation(Vector3d::UnitZ(), along), 0.5 * (foot + head));
  scene_->AddBox(T_W_O, {width, 0.04, along.norm()}, materials_.wood);
}

}  // namespace plm_vins::simulator

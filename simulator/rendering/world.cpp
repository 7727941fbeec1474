// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/world.h"

#include <cmath>
#include <vector>

namespace plm_vins::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Surface = Furnisher::Surface;

// Floor of a box-shaped room centered in x and y, whose walls face toward +x, +y, -x, -y.
std::vector<Vector2d> BoxFloor(const Vector3d& size) {
  const double x = 0.5 * size.x(), y = 0.5 * size.y();
  return {{x, -y}, {x, y}, {-x, y}, {-x, -y}};
}

// Floor of a room whose walls are tangent to a circle about the origin. `headings` are the
// directions of the walls from the origin, increasing by less than pi each [rad].
std::vector<Vector2d> FloorAroundCircle(double radius, const std::vector<double>& headings) {
  std::vector<Vector2d> corners;
  double previous = headings.back() - 2 * M_PI;
  for (const double heading : headings) {
    const double middle = 0.5 * (previous + heading);
    corners.push_back(radius / std::cos(heading - middle) *
                      Vector2d(std::cos(middle), std::sin(middle)));
    previous = heading;
  }
  return corners;
}

// Hangs posters side by side along a wall at different heights. A share of `askew` is rotated.
void HangPosters(Furnisher* furnisher, const Wall& wall, double from, double to, double height,
                 double askew = 0.3) {
  Random& random = furnisher->random();
  for (double x = from; x < to - 0.5;) {
    const double width = random.Uniform(0.35, 0.9), poster_height = random.Uniform(0.4, 0.9);
    const double tilt = random.Uniform() < askew ? random.Uniform(-0.4, 0.4) : 0.0;
    if (x + width > to) return;
    furnisher->AddPoster(wall, x, height + random.Uniform(-0.2, 0.3), width, poster_height, tilt);
    x += width + random.Uniform(0.15, 0.6);
  }
}

// Adds a pipe along the whole wall with branches down to the floor.
void RunPipe(Furnisher* furnisher, const Wall& wall, double height, double radius, double spacing) {
  const double out = 0.12;
  furnisher->AddPipe(wall, {0, height, out}, {wall.width, height, out}, radius);
  for (double x = 0.4 * spacing; x < wall.width; x += spacing) {
    furnisher->AddPipe(wall, {x, 0, out}, {x, height, out}, 0.7 * radius);
  }
}

World MakeRoom(TextureStyle style, uint64_t seed) {
  World world;
  world.flight_center = {0, 0, 1.6};
  world.flight_extent = {1.8, 1.2, 0.5};
  const Vector3d size(8, 6.4, 3.2);
  Furnisher furnisher(&world.scene, style, 0.003, seed);
  const auto walls =
      furnisher.AddRoom(BoxFloor(size), size.z(),
                        {Surface::kPlaster, Surface::kPlaster, Surface::kBricks, Surface::kPlaster},
                        Surface::kTiles, Surface::kPanels);
  const Wall &front = walls[0], &left = walls[1], &back = walls[2], &right = walls[3];

  furnisher.AddWindow(front, 0.7, 0.95, 1.5, 1.3);
  furnisher.AddWindow(front, 4.0, 0.95, 1.5, 1.3);
  HangPosters(&furnisher, front, 2.45, 3.85, 1.2);
  furnisher.AddDoor(left, 0.8);
  furnisher.AddShelf(left, 2.4, 1.6, 2.1);
  HangPosters(&furnisher, left, 4.3, 7.8, 1.3);
  RunPipe(&furnisher, back, 2.75, 0.05, 2.9);
  HangPosters(&furnisher, back, 1.5, 4.0, 1.2);
  furnisher.AddShelf(back, 4.6, 1.2, 1.8);
  furnisher.AddDoor(right, 6.2);
  furnisher.AddShelf(right, 0.6, 1.0, 2.3);
  HangPosters(&furnisher, right, 2.0, 5.9, 1.35);

  furnisher.AddTable({2.6, -2.1, 0}, 0.3);
  furnisher.AddTable({-2.4, 2.0, 0}, -0.2);
  furnisher.AddCrate({3.3, 2.5, 0}, 0.7, 0.5);
  furnisher.AddCrate({-3.2, -2.5, 0}, 0.8, 0.9);
  furnisher.AddPlank({-1.6, -2.5, 0}, {-2.4, -3.15, 2.4}, 0.15);
  furnisher.AddPlank({3.5, 1.2, 0}, {3.95, 0.6, 2.6}, 0.12);
  furnisher.AddLamp({-1.5, 0, size.z() - 0.1}, 2.0, M_PI / 2);
  furnisher.AddLamp({1.8, 0, size.z() - 0.1}, 2.0, M_PI / 2);
  return world;
}

World MakeCorridor(TextureStyle style, uint64_t seed) {
  World world;
  world.flight_center = {-2, 0, 1.5};
  world.flight_extent = {16, 0.6, 0.4};
  const Vector3d size(40, 3, 2.9);
  Furnisher furnisher(&world.scene, style, 0.003, seed);
  const auto walls =
      furnisher.AddRoom(BoxFloor(size), size.z(),
                        {Surface::kPlaster, Surface::kPlaster, Surface::kBricks, Surface::kPlaster},
                        Surface::kTiles, Surface::kPanels);
  for (const Wall* wall : {&walls[1], &walls[3]}) {
    for (double x = 1.2; x < size.x() - 3.5; x += 4.0) {
      furnisher.AddDoor(*wall, x + furnisher.random().Uniform(0, 0.4));
      HangPosters(&furnisher, *wall, x + 1.7, x + 3.7, 1.2);
    }
  }
  RunPipe(&furnisher, walls[1], 2.6, 0.06, 40);
  RunPipe(&furnisher, walls[3], 2.65, 0.04, 6.15);
  furnisher.AddDoor(walls[0], 1.0);
  furnisher.AddWindow(walls[2], 0.8, 0.9, 1.4, 1.2);
  for (double x = -18; x < 20; x += 4) {
    furnisher.AddLamp({x, 0, size.z() - 0.08}, 1.2, 0);
    const double side = std::fmod(x + 18, 8) < 1 ? 1.15 : -1.15;
    furnisher.AddCrate({x + 1.7, side, 0}, furnisher.random().Uniform(0.35, 0.55),
                       furnisher.random().Uniform(0, 1.5));
  }
  return world;
}

// Furnishes each wall with one kind of objects, in turn, and with rotated posters.
void FurnishWall(Furnisher* furnisher, const Wall& wall, size_t index) {
  switch (index % 3) {
    case 0:
      furnisher->AddWindow(wall, 0.6, 0.95, 1.2, 1.3);
      HangPosters(furnisher, wall, 2.0, wall.width - 0.1, 1.2, /*askew=*/1);
      break;
    case 1:
      furnisher->AddShelf(wall, 0.4, 1.1, 2.1);
      HangPosters(furnisher, wall, 1.7, wall.width - 0.1, 1.3, /*askew=*/1);
      break;
    default:
      furnisher->AddDoor(wall, 0.4);
      HangPosters(furnisher, wall, 1.6, wall.width - 0.1, 1.3, /*askew=*/1);
  }
}

// Makes a room of the size of MakeRoom's with seven walls, no two of which are perpendicular.
World MakeIrregular(TextureStyle style, uint64_t seed) {
  constexpr double kRadius = 3.7, kHeight = 3.2;
  constexpr int kWalls = 7;
  Random heading_random(seed, 1);
  std::vector<double> headings;
  for (int i = 0; i < kWalls; ++i) {
    headings.push_back((i + heading_random.Uniform(-0.1, 0.1)) * 2 * M_PI / kWalls);
  }
  World world;
  world.flight_center = {0, 0, 1.6};
  world.flight_extent = {1.6, 1.2, 0.5};
  Furnisher furnisher(&world.scene, style, 0.003, seed);
  const auto walls = furnisher.AddRoom(FloorAroundCircle(kRadius, headings), kHeight,
                                       {Surface::kPlaster}, Surface::kPlaster, Surface::kPlaster);
  for (size_t i = 0; i < walls.size(); ++i) FurnishWall(&furnisher, walls[i], i);

  Random& random = furnisher.random();
  const auto turn = [&random] { return random.Uniform(0, 2 * M_PI); };
  for (int i = 0; i < 8; ++i) {
    const double place = random.Uniform(i, i + 0.5) * M_PI / 4;
    const Vector3d towards(std::cos(place), std::sin(place), 0);
    const double heading = turn();
    if (i % 4 == 0) {
      furnisher.AddTable(2.75 * towards, heading);
    } else if (i % 4 == 1) {
      const double y = random.Uniform(-0.8, 0.8);
      const Vector3d aside(random.Uniform(-0.8, 0.8), y, 2.4);
      furnisher.AddPlank(2.9 * towards, 3.1 * towards + aside, 0.14);
    } else {
      furnisher.AddCrate(2.9 * towards, random.Uniform(0.3, 0.7), heading);
    }
  }
  for (const double x : {-1.6, 0.0, 1.6}) furnisher.AddLamp({x, 0, kHeight - 0.1}, 1.4, turn());
  return world;
}

// Adds one of two identical rooms, 6 x 5 m about x = -5, with half of the corridor on both sides.
void MakeTwin(Furnisher* furnisher, double height) {
  constexpr Surface kPlaster = Surface::kPlaster;
  const auto walls =
      furnisher->AddRoom({{0, -1},
                          {0, 1},
                          {-2, 1},
                          {-2, 2.5},
                          {-8, 2.5},
                          {-8, 1},
                          {-10, 1},
                          {-10, -1},
                          {-8, -1},
                          {-8, -2.5},
                          {-2, -2.5},
                          {-2, -1}},
                         height,
                         {Surface::kOpen, kPlaster, kPlaster, Surface::kBricks, kPlaster, kPlaster,
                          Surface::kOpen, kPlaster, kPlaster, kPlaster, kPlaster, kPlaster},
                         Surface::kTiles, Surface::kPanels);
  const Wall &left = walls[3], &right = walls[9];
  HangPosters(furnisher, left, 0.3, 3.6, 1.3);
  furnisher->AddShelf(left, 4.0, 1.2, 2.1);
  furnisher->AddDoor(right, 0.6);
  HangPosters(furnisher, right, 2.0, 5.7, 1.3);
  for (const int part : {2, 4, 8, 10}) HangPosters(furnisher, walls[part], 0.1, 1.4, 1.2);
  furnisher->AddTable({-3.2, -1.7, 0}, 0.2);
  furnisher->AddCrate({-7.2, 1.8, 0}, 0.6, 0.5);
  furnisher->AddPlank({-4.5, -1.9, 0}, {-5, -2.4, 2.2}, 0.15);
  furnisher->AddLamp({-5, 0, height - 0.1}, 2.0, M_PI / 2);
}

World MakeTwins(TextureStyle style, uint64_t seed) {
  constexpr double kHeight = 2.9;
  World world;
  world.flight_center = {0, 0, 1.5};
  world.flight_extent = {8, 0.6, 0.4};
  Furnisher furnisher(&world.scene, style, 0.003, seed);
  MakeTwin(&furnisher, kHeight);
  world.scene.Repeat({10, 0, 0});
  furnisher.AddWall({10, -1}, {10, 1}, kHeight, Surface::kPlaster);
  furnisher.AddWall({-10, 1}, {-10, -1}, kHeight, Surface::kPlaster);
  return world;
}

}  // namespace

World MakeWorld(WorldKind kind, TextureStyle style, uint64_t seed) {
  switch (kind) {
    case WorldKind::kCorridor:
      return MakeCorridor(style, seed);
    case WorldKind::kTwins:
      return MakeTwins(style, seed);
    case WorldKind::kIrregular:
      return MakeIrregular(style, seed);
    default:
      return MakeRoom(style, seed);
  }
}

}  // namespace plm_vins::simulator

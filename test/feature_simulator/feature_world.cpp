// SPDX-License-Identifier: BSD-3-Clause
#include "test/feature_simulator/feature_world.h"

#include <cmath>

#include "common/geometry/so3.h"
#include "simulator/random.h"

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

constexpr double kMinLineLength = 0.6, kMaxLineLength = 2.5;  // [m]
constexpr double kMaxLean = 0.3;  // tilt of irregular lines about each axis [rad]

// A wall of the room: the axis normal to it and its side (+-1).
struct Wall {
  int axis;
  double side;
};

Wall RandomWall(const Vector3d& size, Random& random) {
  const Vector3d areas(size.y() * size.z(), size.x() * size.z(), size.x() * size.y());
  const double pick = random.Uniform(0, areas.sum());
  const int axis = pick < areas[0] ? 0 : pick < areas[0] + areas[1] ? 1 : 2;
  return {axis, random.Uniform() < 0.5 ? -1.0 : 1.0};
}

// Returns a random point relative to the center of the room.
Vector3d PointOnWall(const Vector3d& size, const Wall& wall, Random& random) {
  Vector3d point = random.UniformInBox(0.5 * size);
  point[wall.axis] = 0.5 * wall.side * size[wall.axis];
  return point;
}

LineSegment3d LineOnWall(const Vector3d& size, double oblique_share, Random& random) {
  const Wall wall = RandomWall(size, random);
  const int u = (wall.axis + 1) % 3, v = (wall.axis + 2) % 3;
  const double angle = random.Uniform() < oblique_share ? random.Uniform(0.2, M_PI / 2 - 0.2)
                       : random.Uniform() < 0.5         ? 0.0
                                                        : M_PI / 2;
  Vector3d direction = Vector3d::Zero();
  direction[u] = std::cos(angle);
  direction[v] = std::sin(angle);
  const Vector3d half = 0.5 * random.Uniform(kMinLineLength, kMaxLineLength) * direction;
  Vector3d center = PointOnWall(size, wall, random);
  for (int axis : {u, v})
    center[axis] *= 1.0 - 2.0 * half[axis] / size[axis];  // stay inside the room
  return {center - half, center + half};
}

// Returns the rotation that turns an axis-aligned line into one of the layout.
Eigen::Quaterniond TurnFor(LineLayout layout, Random& random) {
  const bool chosen = layout != LineLayout::kManhattan && random.Uniform() < 0.5;
  if (layout != LineLayout::kIrregular) return SO3Exp({0, 0, chosen ? kAtlantaTurn : 0.0});
  const double lean = chosen ? kMaxLean : 0.0;
  return SO3Exp(random.UniformInBox({0, 0, M_PI})) * SO3Exp(random.UniformInBox({lean, lean, 0}));
}

LineSegment3d Turned(const LineSegment3d& line, const Eigen::Quaterniond& turn) {
  const Vector3d center = 0.5 * (line.start + line.end), half = turn * (line.end - center);
  return {center - half, center + half};
}

void AddRoomEdges(const Vector3d& size, std::vector<LineSegment3d>* lines) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Vector3d start = -0.5 * size;
      if (corner & 1) start[(axis + 1) % 3] *= -1.0;
      if (corner & 2) start[(axis + 2) % 3] *= -1.0;
      Vector3d end = start;
      end[axis] *= -1.0;
      lines->push_back({start, end});
    }
  }
}

}  // namespace

FeatureWorld MakeFeatureRoom(const FeatureRoomOptions& options, uint64_t seed) {
  Random random(seed);
  FeatureWorld world;
  for (int i = 0; i < options.points; ++i) {
    const Wall wall = RandomWall(options.size, random);
    Vector3d point = PointOnWall(options.size, wall, random);
    point[wall.axis] -= wall.side * random.Uniform(0, options.relief);
    world.points.push_back(point);
  }
  if (options.layout != LineLayout::kIrregular) AddRoomEdges(options.size, &world.lines);
  for (int i = 0; i < options.lines; ++i) {
    const LineSegment3d line = LineOnWall(options.size, options.oblique_share, random);
    world.lines.push_back(Turned(line, TurnFor(options.layout, random)));
  }
  const Vector3d room_center(0, 0, 0.5 * options.size.z());
  for (Vector3d& point : world.points) point += room_center;
  for (LineSegment3d& line : world.lines) line = {line.start + room_center, line.end + room_center};
  return world;
}

}  // namespace plm_vins::simulator

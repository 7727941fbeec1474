// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace plm_vins::simulator {

struct LineSegment3d {
  Eigen::Vector3d start, end;  // [m]
};

// Rotation of the lines about the vertical.
enum class LineLayout {
  kManhattan,  // along the axes of the room, except for the oblique ones
  kAtlanta,    // half of them rotated further by kAtlantaTurn
  kIrregular   // each by a random angle, half of them tilted; the room has no edges
};
constexpr double kAtlantaTurn = 0.55;  // [rad]

struct FeatureRoomOptions {
  Eigen::Vector3d size{10, 8, 4};  // room, centered in x and y, with the floor at z = 0 [m]
  double relief = 0.6;             // largest distance of points from the wall [m]
  int points = 1200;
  int lines = 150;             // in addition to the twelve edges of the room
  double oblique_share = 0.2;  // share of lines that are not along an axis of the room
  LineLayout layout = LineLayout::kManhattan;
};

// Landmarks in W. Points lie on the six walls or in front of them; lines lie on the walls or are
// rotated about their midpoints there.
struct FeatureWorld {
  std::vector<Eigen::Vector3d> points;
  std::vector<LineSegment3d> lines;
};

FeatureWorld MakeFeatureRoom(const FeatureRoomOptions& options, uint64_t seed);

}  // namespace plm_vins::simulator

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace plm_vins::simulator {

struct LineSegment3d {
  Eigen::Vector3d start, end;  // [m]
};

// How the lines are turned about the vertical.
enum class LineLayout {
  kManhattan,  // as the room, but for the oblique ones
  kAtlanta,    // half of them by kAtlantaTurn more
  kIrregular   // each by an angle of its own, half of them leaning too; the room has no edges
};
constexpr double kAtlantaTurn = 0.55;  // [rad]

struct FeatureRoomOptions {
  Eigen::Vector3d size{10, 8, 4};  // of the room, centred in x and y, floor at z = 0 [m]
  double relief = 0.6;             // points stand up to this far in front of the wall [m]
  int points = 1200;
  int lines = 150;             // beside the twelve edges of the room
  double oblique_share = 0.2;  // of the lines that follow no axis of the room
  LineLayout layout = LineLayout::kManhattan;
};

// Landmarks in W. Points lie on and before the six walls; lines on the walls, or turned about their
// middle there.
struct FeatureWorld {
  std::vector<Eigen::Vector3d> points;
  std::vector<LineSegment3d> lines;
};

FeatureWorld MakeFeatureRoom(const FeatureRoomOptions& options, uint64_t seed);

}  // namespace plm_vins::simulator

// SPDX-License-Identifier: BSD-3-Clause
#include "test/feature_simulator/feature_world.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

FeatureWorld MakeWorld(LineLayout layout) {
  FeatureRoomOptions options;
  options.layout = layout;
  options.oblique_share = 0;
  options.lines = 1000;
  return MakeFeatureRoom(options, 1);
}

Vector3d Direction(const LineSegment3d& line) { return (line.end - line.start).normalized(); }

bool IsLevel(const LineSegment3d& line) { return std::abs(Direction(line).z()) < 1e-9; }

// Share of the horizontal lines whose heading is `heading` modulo 90 deg, to one degree.
double ShareAt(double heading, const FeatureWorld& world) {
  int level = 0, there = 0;
  for (const LineSegment3d& line : world.lines) {
    if (!IsLevel(line)) continue;
    const Vector3d d = Direction(line);
    const double difference = std::atan2(d.y(), d.x()) - heading;
    ++level;
    there += std::abs(std::remainder(difference, M_PI / 2)) < M_PI / 180;
  }
  return there / double(level);
}

TEST(FeatureWorld, ManhattanHasOneHorizontalFrame) {
  EXPECT_EQ(ShareAt(0, MakeWorld(LineLayout::kManhattan)), 1);
}

TEST(FeatureWorld, AtlantaHasTwo) {
  const FeatureWorld world = MakeWorld(LineLayout::kAtlanta);
  EXPECT_NEAR(ShareAt(0, world), 0.5, 0.05);
  EXPECT_NEAR(ShareAt(0, world) + ShareAt(kAtlantaTurn, world), 1, 1e-9);
}

TEST(FeatureWorld, IrregularHasNone) {
  const FeatureWorld world = MakeWorld(LineLayout::kIrregular);
  for (int degrees = 0; degrees < 90; ++degrees) {
    EXPECT_LT(ShareAt(degrees * M_PI / 180, world), 0.06) << degrees;  // 0.022 expected
  }
  int leaning = 0;
  for (const LineSegment3d& line : world.lines) {
    leaning += !IsLevel(line) && Direction(line).head<2>().norm() > 1e-9;
  }
  EXPECT_NEAR(leaning / 1000.0, 0.5, 0.05);
}

}  // namespace
}  // namespace plm_vins::simulator

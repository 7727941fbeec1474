// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/feature_door.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

PointFrame StereoPointsWithDepth() {
  PointFrame frame;
  frame.points.push_back({1, {0.25, -0.5}, {300.5, 200.25}, {0.125, -2}, 0, 2.5});
  frame.points.push_back({1, {0.125, -0.5}, {280.5, 200.25}, {0.125, -2}, 1});
  return frame;
}

SensorConfig Cameras(int count) {
  SensorConfig sensor;
  sensor.cameras.resize(count);
  return sensor;
}

// A tracker with another configuration may send more than this one has.
TEST(FeatureDoor, RemovesWhatTheConfigurationDoesNotHave) {
  FeatureDoor door(Cameras(1));
  PointFrame points = StereoPointsWithDepth();
  LineFrame lines;
  lines.lines.push_back({7, {0.25, -0.5}, {0.5, 0.125}});
  lines.lines.push_back({7, {0.125, -0.5}, {0.375, 0.125}, 1, {0.25, 0.5}});
  door.Admit(&points);
  door.Admit(&lines);
  ASSERT_EQ(points.points.size(), 1u);
  EXPECT_FALSE(points.points[0].depth);
  ASSERT_EQ(lines.lines.size(), 1u);
  EXPECT_EQ(lines.lines[0].camera, 0);
  const DropCounts drops = door.Drops();
  ASSERT_EQ(drops.size(), 2u);
  EXPECT_EQ(drops[0].count, 2);
  EXPECT_EQ(drops[0].detail, "the configuration has num_of_cam: 1, but the tracker's has more");
  EXPECT_EQ(drops[1].count, 1);
}

TEST(FeatureDoor, AdmitsWhatTheConfigurationHas) {
  SensorConfig sensor = Cameras(2);
  sensor.depth.emplace();
  FeatureDoor door(sensor);
  PointFrame points = StereoPointsWithDepth();
  door.Admit(&points);
  EXPECT_EQ(points.points.at(0).depth, 2.5);
  EXPECT_EQ(points.points.at(1).xy, Eigen::Vector2d(0.125, -0.5));
  EXPECT_TRUE(door.Drops().empty());
}

}  // namespace
}  // namespace plm_vins

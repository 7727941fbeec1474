// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/map_messages.h"

#include <gtest/gtest.h>

#include "common/ros/geometry_conversion.h"

namespace plm_vins {
namespace {

MapFix QuarterTurn() {
  MapFix fix;
  fix.T_M_O = {M_PI / 2, {0, 0, 5}};
  fix.T_O_L.translation = {1, 0, 0};
  fix.covariance = 0.5 * Matrix4d::Identity();
  return fix;
}

nav_msgs::Odometry OdometryAtTheKeyframe() {
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "world";
  odometry.pose.pose.position.x = 1;
  odometry.pose.pose.orientation.w = 1;
  return odometry;
}

TEST(ToMap, TransformsPoseAndCovariance) {
  nav_msgs::Odometry odometry = OdometryAtTheKeyframe();
  odometry.pose.covariance[0] = 4;   // of x, which is y in the map: the drift since the keyframe
  odometry.pose.covariance[21] = 9;  // of roll, which is pitch in the map
  odometry.pose.covariance[35] = 1;  // of yaw
  odometry.twist.twist.linear.x = 3;
  const nav_msgs::Odometry in_map = ToMap(odometry, QuarterTurn(), "map");
  EXPECT_EQ(in_map.header.frame_id, "map");
  EXPECT_NEAR(in_map.pose.pose.position.y, 1, 1e-12);
  EXPECT_NEAR(in_map.pose.pose.position.z, 5, 1e-12);
  EXPECT_NEAR(in_map.pose.covariance[0], 0.5, 1e-5);
  EXPECT_NEAR(in_map.pose.covariance[7], 4.5, 1e-5);
  EXPECT_NEAR(in_map.pose.covariance[21], 0, 1e-12);
  EXPECT_NEAR(in_map.pose.covariance[28], 9, 1e-12);
  EXPECT_NEAR(in_map.pose.covariance[35], 1.5, 1e-5);
  EXPECT_EQ(in_map.twist.twist.linear.x, 3);
}

TEST(ToMap, KeepsAnUnknownCovariance) {
  nav_msgs::Odometry odometry = OdometryAtTheKeyframe();
  for (size_t i = 0; i < 36; i += 7) odometry.pose.covariance[i] = kUnknownVariance;
  EXPECT_EQ(ToMap(odometry, QuarterTurn(), "map").pose.covariance, odometry.pose.covariance);
}

// Two keyframes connected by an odometry edge and a loop, and one of another world.
KeyframeMap SmallMap() {
  KeyframeMap map;
  for (int i = 0; i < 3; ++i) {
    map.keyframes.emplace_back().t_ns = i;
    map.graph.AddNode({0, {1.0 * i, 0, 0}});
  }
  map.graph.AddEdge({0, 1, {}, Matrix4d::Identity(), false});
  map.graph.AddEdge({0, 1, {}, Matrix4d::Identity(), true});
  return map;
}

TEST(ToPath, HasTheComponentOfTheNewestKeyframe) {
  KeyframeMap map = SmallMap();
  const nav_msgs::Path apart = ToPath(map, "map", "world");
  EXPECT_EQ(apart.poses.size(), 1u);
  EXPECT_EQ(apart.header.frame_id, "world") << "it has no place in the map";
  map.graph.AddEdge({1, 2, {}, Matrix4d::Identity(), false});
  const nav_msgs::Path path = ToPath(map, "map", "world");
  EXPECT_EQ(path.header.frame_id, "map");
  ASSERT_EQ(path.poses.size(), 3u);
  EXPECT_EQ(path.poses[2].pose.position.x, 2);
}

TEST(ToPath, LengthIsBounded) {
  KeyframeMap map;
  for (int i = 0; i < 6000; ++i) {
    map.keyframes.emplace_back().t_ns = i;
    map.graph.AddNode({});
    if (i > 0) map.graph.AddEdge({i - 1, i, {}, Matrix4d::Identity(), false});
  }
  const nav_msgs::Path path = ToPath(map, "map", "world");
  EXPECT_EQ(path.poses.size(), 5000u);
  EXPECT_EQ(path.header.stamp, ros::Time(0, 5999));
}

TEST(ToPath, IsEmptyForAnEmptyMap) {
  EXPECT_TRUE(ToPath(KeyframeMap(), "map", "world").poses.empty());
}

TEST(ToGraphMarkers, SeparateOdometryAndLoopEdges) {
  const auto markers = ToGraphMarkers(SmallMap(), "map").markers;
  ASSERT_EQ(markers.size(), 2u);
  EXPECT_EQ(markers[0].points.size(), 2u);
  EXPECT_EQ(markers[1].ns, "loops");
  EXPECT_EQ(markers[1].points.size(), 2u);
  EXPECT_EQ(markers[1].action, visualization_msgs::Marker::ADD);
  EXPECT_EQ(markers[1].header.stamp, ros::Time(0, 2));  // of the newest keyframe
}

TEST(ToGraphMarkers, OmitWorldsNotConnectedToTheMap) {
  KeyframeMap map = SmallMap();
  map.keyframes.emplace_back().t_ns = 3;
  map.graph.AddNode({});
  map.graph.AddEdge({2, 3, {}, Matrix4d::Identity(), false});
  EXPECT_EQ(ToGraphMarkers(map, "map").markers[0].points.size(), 2u);
}

TEST(ToGraphMarkers, DeleteEmptyMarkers) {
  KeyframeMap map = SmallMap();
  map.graph = PoseGraph();
  for (const auto& marker : ToGraphMarkers(map, "map").markers) {
    EXPECT_EQ(marker.action, visualization_msgs::Marker::DELETE);
  }
}

}  // namespace
}  // namespace plm_vins

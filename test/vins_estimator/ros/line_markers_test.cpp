// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/line_markers.h"

#include <gtest/gtest.h>

#include <set>

namespace plm_vins {
namespace {

using visualization_msgs::Marker;

std::vector<MapLine> MakeLines(size_t count) {
  std::vector<MapLine> lines(count);
  for (size_t i = 0; i < count; ++i) lines[i].start_W = Eigen::Vector3d(i, 0, 0);
  return lines;
}

TEST(LineMarker, JoinsTheEndsOfEachLine) {
  const std::vector<MapLine> lines = {{7, {1, 2, 3}, {4, 5, 6}, LineAxis::kX},
                                      {8, {0, 0, 0}, {0, 0, 1}, LineAxis::kFree}};
  const Marker marker = ToLineMarker(lines, 1'500'000'000, "world", "lines");
  EXPECT_EQ(marker.type, Marker::LINE_LIST);
  EXPECT_EQ(marker.action, Marker::ADD);
  EXPECT_EQ(marker.header.frame_id, "world");
  EXPECT_EQ(marker.header.stamp, ros::Time(1, 500'000'000));
  EXPECT_EQ(marker.pose.orientation.w, 1);
  EXPECT_GT(marker.scale.x, 0);
  ASSERT_EQ(marker.points.size(), 4u);
  ASSERT_EQ(marker.colors.size(), 4u);
  EXPECT_EQ(marker.points[1].y, 5);
  EXPECT_GT(marker.colors[0].r, marker.colors[0].g);
  EXPECT_EQ(marker.colors[3].r, marker.colors[3].g);
  EXPECT_EQ(marker.colors[3].a, 1);
}

TEST(LineMarker, ShowsTheAxesInDifferentColours) {
  std::set<std::vector<float>> colors;
  for (const LineAxis axis : {LineAxis::kFree, LineAxis::kX, LineAxis::kY, LineAxis::kZ}) {
    const auto color = ToLineMarker({{1, {}, {}, axis}}, 0, "world", "lines").colors.at(0);
    colors.insert({color.r, color.g, color.b});
  }
  EXPECT_EQ(colors.size(), 4u);
}

TEST(LineHistory, HasNothingToSayWithoutLines) {
  EXPECT_TRUE(LineHistory("world").Add({}, 1).empty());
}

TEST(LineHistory, GrowsOneMarkerThenTheNext) {
  LineHistory history("world");
  auto changed = history.Add(MakeLines(LineHistory::kLinesPerMarker - 1), 1);
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].id, 0);
  changed = history.Add(MakeLines(3), 2);
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_EQ(changed[0].id, 0);
  EXPECT_EQ(changed[0].points.size(), 2 * LineHistory::kLinesPerMarker);
  EXPECT_EQ(changed[1].id, 1);
  EXPECT_EQ(changed[1].points.size(), 4u);
  EXPECT_EQ(changed[1].points[0].x, 1);
}

TEST(LineHistory, StaysBoundedInALongRun) {
  LineHistory history("world");
  std::set<int> ids;
  for (int i = 0; i < 3 * LineHistory::kMaxMarkers; ++i) {
    for (const Marker& marker : history.Add(MakeLines(LineHistory::kLinesPerMarker), i)) {
      EXPECT_LE(marker.points.size(), 2 * LineHistory::kLinesPerMarker);
      ids.insert(marker.id);
    }
  }
  EXPECT_EQ(ids.size(), static_cast<size_t>(LineHistory::kMaxMarkers));
}

TEST(LineHistory, ClearStartsAgain) {
  LineHistory history("world");
  history.Add(MakeLines(250), 1);
  EXPECT_EQ(history.Clear().action, Marker::DELETEALL);
  const auto changed = history.Add(MakeLines(1), 2);
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].id, 0);
  EXPECT_EQ(changed[0].points.size(), 2u);
}

}  // namespace
}  // namespace plm_vins

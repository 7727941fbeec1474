// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/line_markers.h"

#include <gtest/gtest.h>

#include <set>

namespace plm_vins {
namespace {

using visualization_msgs::Marker;

// Lines with ids from `first` on, each beginning at x = id.
std::vector<MapLine> MakeLines(int64_t first, size_t count) {
  std::vector<MapLine> lines(count);
  for (size_t i = 0; i < count; ++i) {
    lines[i].id = first + static_cast<int64_t>(i);
    lines[i].start_W.x() = static_cast<double>(lines[i].id);
  }
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

TEST(LineMarker, ShowsTheAxesInDifferentColors) {
  std::set<std::vector<float>> colors;
  for (const LineAxis axis : {LineAxis::kFree, LineAxis::kX, LineAxis::kY, LineAxis::kZ}) {
    const auto color =
        ToLineMarker({{1, {0, 0, 0}, {1, 0, 0}, axis}}, 0, "world", "lines").colors.at(0);
    colors.insert({color.r, color.g, color.b});
  }
  EXPECT_EQ(colors.size(), 4u);
}

// An empty list would be an error in rviz.
TEST(LineMarker, IsDeletedWithoutLines) {
  const Marker marker = ToLineMarker({}, 1, "world", "lines");
  EXPECT_EQ(marker.action, Marker::DELETE);
  EXPECT_EQ(marker.ns, "lines");
}

TEST(LineHistory, IsEmptyWithoutLines) { EXPECT_TRUE(LineHistory("world").Add({}, 1).empty()); }

TEST(LineHistory, GrowsOneMarkerThenTheNext) {
  constexpr size_t kFull = LineHistory::kLinesPerMarker;
  LineHistory history("world");
  auto changed = history.Add(MakeLines(0, kFull - 1), 1);
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].id, 0);
  changed = history.Add(MakeLines(kFull - 1, 3), 2);
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_EQ(changed[0].id, 0);
  EXPECT_EQ(changed[0].points.size(), 2 * kFull);
  EXPECT_EQ(changed[1].id, 1);
  EXPECT_EQ(changed[1].points.size(), 4u);
  EXPECT_EQ(changed[1].points[0].x, kFull);
}

TEST(LineHistory, ReplacesARecognizedLineThatLeavesAgain) {
  constexpr size_t kFull = LineHistory::kLinesPerMarker;
  LineHistory history("world");
  std::vector<MapLine> known = MakeLines(0, 2 * kFull + 1);
  history.Add(known, 1);
  for (MapLine& line : known) line.start_W.x() *= -1;
  const auto changed = history.Add({known[3], known[4], known[2 * kFull]}, 2);
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_EQ(changed[0].id, 0);
  EXPECT_EQ(changed[0].points.size(), 2 * kFull);
  EXPECT_EQ(changed[0].points[2 * 2].x, 2);
  EXPECT_EQ(changed[0].points[2 * 3].x, -3);
  EXPECT_EQ(changed[0].points[2 * 4].x, -4);
  EXPECT_EQ(changed[1].id, 2);
  EXPECT_EQ(changed[1].points.size(), 2u);
  EXPECT_EQ(changed[1].points[0].x, -2.0 * kFull);
}

TEST(LineHistory, DropsMergedLines) {
  constexpr size_t kFull = LineHistory::kLinesPerMarker;
  LineHistory history("world");
  history.Add(MakeLines(0, kFull + 1), 1);
  history.Remove({3, static_cast<int64_t>(kFull) - 1, static_cast<int64_t>(kFull), 999});
  auto changed = history.Add({}, 2);
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_EQ(changed[0].points.size(), 2 * (kFull - 2));
  for (const auto& point : changed[0].points) EXPECT_NE(point.x, 3);
  EXPECT_EQ(changed[1].action, visualization_msgs::Marker::DELETE);
  EXPECT_TRUE(history.Add({}, 3).empty());
  const auto last = MakeLines(static_cast<int64_t>(kFull) - 2, 1);  // it has a place already
  EXPECT_EQ(history.Add(last, 4).at(0).points.size(), 2 * (kFull - 2));
}

TEST(LineHistory, HasAllMarkersThatAreNotEmpty) {
  constexpr size_t kFull = LineHistory::kLinesPerMarker;
  LineHistory history("world");
  EXPECT_TRUE(history.All().empty());
  history.Add(MakeLines(0, 2 * kFull + 1), 1);
  history.Remove({2 * static_cast<int64_t>(kFull)});
  history.Add(MakeLines(0, 1), 2);
  const auto all = history.All();
  ASSERT_EQ(all.size(), 2u);
  for (int i : {0, 1}) {
    EXPECT_EQ(all[i].id, i);
    EXPECT_EQ(all[i].action, Marker::ADD);
    EXPECT_EQ(all[i].points.size(), 2 * kFull);
    EXPECT_EQ(all[i].header.stamp, ros::Time(0, 2));
  }
  history.Clear();
  EXPECT_TRUE(history.All().empty());
}

TEST(LineHistory, StaysBoundedInALongRun) {
  constexpr size_t kFull = LineHistory::kLinesPerMarker;
  LineHistory history("world");
  std::set<int> ids;
  for (size_t i = 0; i < 3 * LineHistory::kMaxMarkers; ++i) {
    for (const Marker& marker : history.Add(MakeLines(i * kFull, kFull), 1)) {
      EXPECT_LE(marker.points.size(), 2 * kFull);
      ids.insert(marker.id);
    }
  }
  EXPECT_EQ(ids.size(), LineHistory::kMaxMarkers);
}

TEST(LineHistory, AddsALineAgainAfterItsMarkerWasOverwritten) {
  constexpr size_t kFull = LineHistory::kLinesPerMarker;
  constexpr size_t kAll = kFull * LineHistory::kMaxMarkers;
  LineHistory history("world");
  history.Add(MakeLines(0, kAll), 1);
  auto changed = history.Add(MakeLines(kAll, 1), 2);  // overwrites the first marker
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].id, 0);
  EXPECT_EQ(changed[0].points.size(), 2u);
  changed = history.Add(MakeLines(1, 1), 3);
  ASSERT_EQ(changed.size(), 1u);
  ASSERT_EQ(changed[0].points.size(), 4u);
  EXPECT_EQ(changed[0].points[0].x, kAll);
  EXPECT_EQ(changed[0].points[2].x, 1);
}

TEST(LineHistory, ClearStartsAgain) {
  LineHistory history("world");
  history.Add(MakeLines(0, LineHistory::kLinesPerMarker + 10), 1);
  EXPECT_EQ(history.Clear().action, Marker::DELETEALL);
  const auto changed = history.Add(MakeLines(LineHistory::kLinesPerMarker, 1), 2);
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].id, 0);
  EXPECT_EQ(changed[0].points.size(), 2u);
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/map_thinning.h"

#include <gtest/gtest.h>

#include "common/measurements.h"
#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

class MapThinningTest : public ::testing::Test {
 protected:
  // Adds a keyframe at x [m], rotated by `turn` to the left [deg] and connected with the previous
  // one of its world.
  void Visit(double t, double x, double turn = 0, int world = 0) {
    Keyframe keyframe;
    keyframe.t_ns = ToNanoseconds(t);
    keyframe.world = world;
    keyframe.T_B_C = {testing::LookingAhead()};
    keyframe.T_O_B = {
        Eigen::Quaterniond(Eigen::AngleAxisd(turn * M_PI / 180, Eigen::Vector3d::UnitZ())),
        {x, 0, 0}};
    keyframe.corners.resize(1);
    const int number = map_.graph.AddNode(keyframe.T_O_L());
    if (number > 0 && map_.keyframes.back().world == world) {
      LevelEdge edge;
      edge.from = number - 1;
      edge.to = number;
      edge.T_from_to = map_.graph.node(number - 1).Inverse() * map_.graph.node(number);
      edge.way = way_;
      map_.graph.AddEdge(edge);
    }
    map_.keyframes.push_back(keyframe);
  }

  std::vector<int> Dispensable() {
    std::vector<int> numbers;
    while (const auto keyframe = thinning_.Next(map_)) {
      numbers.push_back(keyframe->number);
      nearest_.push_back(keyframe->nearest);
      map_.Remove(keyframe->number, keyframe->nearest);
    }
    return numbers;
  }

  static MapThinningOptions Options() {
    MapThinningOptions options;
    options.enough = 3;
    return options;
  }

  KeyframeMap map_;
  MapThinning thinning_{Options()};
  double way_ = 0;  // of the following edges
  std::vector<int> nearest_;
};

TEST_F(MapThinningTest, RemovesARedundantKeyframe) {
  for (int visit = 0; visit < 4; ++visit) Visit(100 * visit, 0.1 * visit);
  EXPECT_TRUE(Dispensable().empty());  // the fourth is too young
  Visit(400, 10);
  EXPECT_EQ(Dispensable(), std::vector<int>{3});
  EXPECT_EQ(nearest_, std::vector<int>{2});
  EXPECT_TRUE(Dispensable().empty());  // each is examined once
}

TEST_F(MapThinningTest, KeepsDistantOrDifferentViews) {
  for (const double x : {0.0, 0.0, 0.0, 0.6}) Visit(100 * x, x);
  Visit(100, 0, /*turn=*/30);
  Visit(200, 10);
  EXPECT_TRUE(Dispensable().empty());
}

TEST_F(MapThinningTest, DoesNotTrustOdometryAfterALongPath) {
  for (int visit = 0; visit < 3; ++visit) Visit(visit, 0);
  way_ = 30;
  Visit(100, 0);
  Visit(200, 10);
  EXPECT_TRUE(Dispensable().empty());
}

TEST_F(MapThinningTest, DoesNotCompareUnconnectedWorlds) {
  for (int visit = 0; visit < 3; ++visit) Visit(visit, 0);
  Visit(100, 0, 0, /*world=*/1);
  Visit(200, 10, 0, /*world=*/1);
  EXPECT_TRUE(Dispensable().empty());
}

TEST_F(MapThinningTest, DoesNotCountRemovedKeyframes) {
  for (const double x : {0.0, 0.2, 0.3}) Visit(x, x);
  Visit(100, 0.4);
  Visit(200, 0.65);  // three are near, one of which is removed
  Visit(300, 10);
  EXPECT_EQ(Dispensable(), std::vector<int>{3});
}

TEST_F(MapThinningTest, ChecksOnlyTheNewestInAThinnedMap) {
  for (int visit = 0; visit < 5; ++visit) Visit(visit, 0);
  Visit(100, 0);
  thinning_.StartBehind(map_);
  Visit(200, 10, 0, /*world=*/1);
  EXPECT_EQ(Dispensable(), std::vector<int>{5});
}

TEST(KeyframeMap, CompactDropsRemovedKeyframes) {
  KeyframeMap map;
  for (int i = 0; i < 4; ++i) {
    map.graph.AddNode({0, {1.0 * i, 0, 0}});
    map.keyframes.emplace_back().t_ns = i;
    if (i > 0) map.graph.AddEdge({i - 1, i, {0, {1, 0, 0}}});
  }
  map.keyframes[1].corners.resize(5);
  map.Remove(1, 0);
  EXPECT_TRUE(map.keyframes[1].corners.empty());
  EXPECT_EQ(map.CountKept(), 3);
  const KeyframeMap compact = map.Compact();
  ASSERT_EQ(compact.graph.size(), 3);
  EXPECT_EQ(compact.keyframes[1].t_ns, 2);
  EXPECT_EQ(compact.graph.node(1).translation.x(), 2);
  ASSERT_EQ(compact.graph.edges().size(), 2u);
  for (const LevelEdge& edge : compact.graph.edges()) EXPECT_EQ(std::abs(edge.to - edge.from), 1);
}

}  // namespace
}  // namespace plm_vins

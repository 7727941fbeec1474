// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph/pose_graph.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins {
namespace {

Matrix4d Variance(double position, double yaw) {
  Vector4d deviations;
  deviations << Eigen::Vector3d::Constant(position), yaw;
  return deviations.cwiseAbs2().asDiagonal();
}

LevelEdge Edge(int from, int to, const LevelTransform& T_from_to, bool is_loop,
               const Matrix4d& covariance) {
  return {from, to, T_from_to, covariance, is_loop};
}

// A way of `count` metres along x.
PoseGraph Straight(int count) {
  PoseGraph graph;
  for (int i = 0; i <= count; ++i) {
    graph.AddNode({0, {1.0 * i, 0, 0}});
    if (i > 0) graph.AddEdge(Edge(i - 1, i, {0, {1, 0, 0}}, false, Variance(0.1, 0.01)));
  }
  return graph;
}

TEST(PoseGraph, LeavesAGraphThatFits) {
  PoseGraph graph = Straight(5);
  graph.AddEdge(Edge(0, 5, {0, {5, 0, 0}}, true, Variance(0.1, 0.01)));
  EXPECT_TRUE(graph.Optimize().empty());
  for (int i = 0; i <= 5; ++i) {
    EXPECT_LT((graph.node(i).translation - Eigen::Vector3d(i, 0, 0)).norm(), 1e-9);
  }
}

// n steps of variance s^2 and one loop of variance s^2 share an error of height equally: each takes
// 1 / (n + 1) of it. The loop is within the robust loss' width, where it is nearly quadratic.
TEST(PoseGraph, DistributesAnErrorOverAllEdgesAlike) {
  PoseGraph graph = Straight(9);
  const double error = 0.02;
  graph.AddEdge(Edge(0, 9, {0, {9, 0, error}}, true, Variance(0.1, 0.01)));
  graph.Optimize();
  for (int i = 0; i <= 9; ++i) {
    EXPECT_NEAR(graph.node(i).translation.z(), error / 10 * i, 1e-4) << i;
  }
}

TEST(PoseGraph, GivesTheErrorToTheUncertainEdge) {
  PoseGraph graph;
  for (int i = 0; i < 3; ++i) graph.AddNode({0, {1.0 * i, 0, 0}});
  graph.AddEdge(Edge(0, 1, {0, {1, 0, 0}}, false, Variance(0.01, 0.01)));
  graph.AddEdge(Edge(1, 2, {0, {1, 0, 0}}, false, Variance(0.1, 0.01)));
  graph.AddEdge(Edge(0, 2, {0, {2, 0, 0.05}}, true, Variance(0.001, 0.01)));
  graph.Optimize();
  EXPECT_NEAR(graph.node(1).translation.z(), 0.05 / 101, 1e-4);
  EXPECT_NEAR(graph.node(2).translation.z(), 0.05, 1e-4);
}

TEST(PoseGraph, ClosesACircleThatDriftedInYaw) {
  // A square: at each corner a quarter turn, of which odometry missed a bit.
  constexpr double kDrift = 0.01;
  PoseGraph graph;
  LevelTransform at;
  graph.AddNode(at);
  for (int i = 0; i < 4; ++i) {
    const LevelTransform step = {M_PI / 2 - kDrift, {5, 0, 0}};
    at = at * step;
    graph.AddNode(at);
    graph.AddEdge(Edge(i, i + 1, step, false, Variance(0.001, 0.02)));
  }
  graph.AddEdge(Edge(0, 4, LevelTransform(), true, Variance(0.01, 0.01)));
  EXPECT_TRUE(graph.Optimize().empty());
  EXPECT_LT(graph.node(4).translation.norm(), 0.01);
  EXPECT_NEAR(WrapAngle(graph.node(4).yaw), 0, 0.005);
  EXPECT_LT((graph.node(2).translation - Eigen::Vector3d(5, 5, 0)).norm(), 0.06);
}

TEST(PoseGraph, TakesOutALoopThatContradictsTheOthers) {
  PoseGraph graph = Straight(20);
  graph.AddEdge(Edge(0, 20, {0, {20, 0, 0.1}}, true, Variance(0.05, 0.01)));
  graph.AddEdge(Edge(1, 19, {0, {18, 0, 0.1}}, true, Variance(0.05, 0.01)));
  graph.AddEdge(Edge(2, 18, {0, {11, 4, 0}}, true, Variance(0.05, 0.01)));
  const auto dropped = graph.Optimize();
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped.front().from, 2);
  EXPECT_EQ(graph.edges().size(), 22u);
  EXPECT_NEAR(graph.node(20).translation.z(), 0.1, 0.02);
  EXPECT_NEAR(graph.node(20).translation.x(), 20, 0.02);
}

TEST(PoseGraph, KeepsPartsThatNothingConnectsApart) {
  PoseGraph graph = Straight(2);
  graph.AddNode({1.0, {50, 0, 0}});
  graph.AddNode({1.0, {50, 1, 0}});
  graph.AddEdge(Edge(3, 4, {0, {0, 2, 0}}, false, Variance(0.1, 0.01)));
  EXPECT_TRUE(graph.AreConnected(0, 2));
  EXPECT_FALSE(graph.AreConnected(2, 3));
  graph.Optimize();
  EXPECT_EQ(graph.node(3).translation.x(), 50);  // the first of its part
  EXPECT_NEAR((graph.node(4).translation - graph.node(3).translation).norm(), 2, 1e-6);
  EXPECT_TRUE(std::isinf(graph.Distance(0, 4)));
}

TEST(PoseGraph, MovesOnePartAlone) {
  PoseGraph graph = Straight(2);
  graph.AddNode({0, {50, 0, 0}});
  graph.MovePart(1, {0, {0, 0, 7}});
  EXPECT_EQ(graph.node(0).translation.z(), 7);
  EXPECT_EQ(graph.node(2).translation.z(), 7);
  EXPECT_EQ(graph.node(3).translation.z(), 0);
}

TEST(PoseGraph, MeasuresTheShortestWayALoopBeingNone) {
  PoseGraph graph = Straight(10);
  EXPECT_NEAR(graph.Distance(0, 9), 9, 1e-12);
  graph.AddEdge(Edge(1, 8, {0, {7, 0, 0}}, true, Variance(0.1, 0.01)));
  EXPECT_NEAR(graph.Distance(0, 9), 2, 1e-12);
}

TEST(PoseGraph, MeasuresYawTheShortWayRound) {
  PoseGraph graph;
  graph.AddNode({3.1, {0, 0, 0}});
  graph.AddNode({-3.1, {0, 0, 0}});
  const LevelEdge edge = Edge(0, 1, {2 * M_PI - 6.2, {0, 0, 0}}, true, Variance(0.1, 0.01));
  EXPECT_NEAR(graph.Deviations(edge), 0, 1e-9);
  graph.AddEdge(edge);
  EXPECT_TRUE(graph.Optimize().empty());
  EXPECT_NEAR(graph.node(1).yaw, -3.1, 1e-6);
}

TEST(Deviations, AreThoseOfTheCovariance) {
  Vector4d error;
  error << 0.3, 0, 0, 0.04;
  EXPECT_NEAR(Deviations(error, Variance(0.1, 0.01)), 5, 1e-9);
}

}  // namespace
}  // namespace plm_vins

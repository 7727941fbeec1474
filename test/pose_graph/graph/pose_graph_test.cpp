// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph/pose_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace plm_vins {
namespace {

Matrix4d Variance(double position, double yaw) {
  Vector4d deviations;
  deviations << Eigen::Vector3d::Constant(position), yaw;
  return deviations.cwiseAbs2().asDiagonal();
}

LevelEdge Edge(int from, int to, const LevelTransform& T_from_to, bool is_loop,
               const Matrix4d& covariance) {
  return {from, to, T_from_to, covariance, is_loop, is_loop ? 0 : T_from_to.translation.norm()};
}

// A straight path of `count` meters along x.
PoseGraph Straight(int count) {
  PoseGraph graph;
  for (int i = 0; i <= count; ++i) {
    graph.AddNode({0, {1.0 * i, 0, 0}});
    if (i > 0) graph.AddEdge(Edge(i - 1, i, {0, {1, 0, 0}}, false, Variance(0.1, 0.01)));
  }
  return graph;
}

// A node relative to the first one, since the whole graph may be anywhere.
LevelTransform FromFirst(const PoseGraph& graph, int node) {
  return graph.node(0).Inverse() * graph.node(node);
}

// A circle of `count` edges whose yaws have errors of error() standard deviations.
template <typename Error>
PoseGraph Circle(int count, double yaw_deviation, const Error& error) {
  PoseGraph graph;
  graph.AddNode({});
  for (int i = 0; i < count; ++i) {
    const LevelTransform step = {2 * M_PI / count + yaw_deviation * error(), {0.3, 0, 0}};
    graph.AddNode(graph.node(i) * step);
    graph.AddEdge(Edge(i, i + 1, step, false, Variance(0.002, yaw_deviation)));
  }
  return graph;
}

TEST(PoseGraph, KeepsAConsistentGraph) {
  PoseGraph graph = Straight(5);
  graph.AddEdge(Edge(0, 5, {0, {5, 0, 0}}, true, Variance(0.1, 0.01)));
  EXPECT_TRUE(graph.Optimize().empty());
  for (int i = 0; i <= 5; ++i) {
    EXPECT_LT((graph.node(i).translation - Eigen::Vector3d(i, 0, 0)).norm(), 1e-9);
  }
}

// n edges of variance s^2 and a loop of variance s^2 share a height error equally, 1 / (n + 1)
// each. The loop's residual is small, so that its robust loss is nearly quadratic.
TEST(PoseGraph, DistributesAnErrorEvenly) {
  PoseGraph graph = Straight(9);
  const double error = 0.02;
  graph.AddEdge(Edge(0, 9, {0, {9, 0, error}}, true, Variance(0.1, 0.01)));
  graph.Optimize();
  for (int i = 0; i <= 9; ++i) {
    EXPECT_NEAR(FromFirst(graph, i).translation.z(), error / 10 * i, 1e-4) << i;
  }
}

TEST(PoseGraph, UncertainEdgeTakesTheError) {
  PoseGraph graph;
  for (int i = 0; i < 3; ++i) graph.AddNode({0, {1.0 * i, 0, 0}});
  graph.AddEdge(Edge(0, 1, {0, {1, 0, 0}}, false, Variance(0.01, 0.01)));
  graph.AddEdge(Edge(1, 2, {0, {1, 0, 0}}, false, Variance(0.1, 0.01)));
  graph.AddEdge(Edge(0, 2, {0, {2, 0, 0.05}}, true, Variance(0.001, 0.01)));
  graph.Optimize();
  EXPECT_NEAR(FromFirst(graph, 1).translation.z(), 0.05 / 101, 1e-4);
  EXPECT_NEAR(FromFirst(graph, 2).translation.z(), 0.05, 1e-4);
}

TEST(PoseGraph, ClosesACircleThatDriftedInYaw) {
  // A square with a quarter turn at each corner, of which odometry missed a bit.
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
  EXPECT_LT(FromFirst(graph, 4).translation.norm(), 0.01);
  EXPECT_NEAR(WrapAngle(FromFirst(graph, 4).yaw), 0, 0.005);
  EXPECT_LT((FromFirst(graph, 2).translation - Eigen::Vector3d(5, 5, 0)).norm(), 0.06);
}

TEST(PoseGraph, DropsALoopThatContradictsTheOthers) {
  PoseGraph graph = Straight(20);
  graph.AddEdge(Edge(0, 20, {0, {20, 0, 0.1}}, true, Variance(0.05, 0.01)));
  graph.AddEdge(Edge(1, 19, {0, {18, 0, 0.1}}, true, Variance(0.05, 0.01)));
  graph.AddEdge(Edge(2, 18, {0, {11, 4, 0}}, true, Variance(0.05, 0.01)));
  const auto dropped = graph.Optimize();
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped.front().from, 2);
  EXPECT_EQ(graph.edges().size(), 22u);
  EXPECT_NEAR(FromFirst(graph, 20).translation.z(), 0.1, 0.02);
  EXPECT_NEAR(FromFirst(graph, 20).translation.x(), 20, 0.02);
}

// Such a chain bends easily as a whole, but hardly at a single edge, which takes many iterations.
TEST(PoseGraph, ClosesALongPathByACorrectLoop) {
  constexpr int kSteps = 2000;
  for (const uint32_t seed : {1, 2, 3, 4, 5}) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    PoseGraph graph = Circle(kSteps, 6e-4, [&] { return normal(random); });
    const LevelEdge loop = Edge(0, kSteps, {}, true, Variance(0.02, 1e-3));
    EXPECT_GT(graph.Deviations(loop), 10) << seed;
    graph.AddEdge(loop);
    EXPECT_TRUE(graph.Optimize().empty()) << seed;
    EXPECT_LT(graph.Deviations(loop), 0.5) << seed;
  }
}

TEST(PoseGraph, DroppedLoopDoesNotDistortIt) {
  constexpr int kSteps = 2000;
  PoseGraph graph = Circle(kSteps, 3e-4, [] { return 0; });
  const PoseGraph before = graph;
  graph.AddEdge(Edge(0, kSteps, {0.1, {0, 4, 0}}, true, Variance(0.02, 1e-3)));
  ASSERT_EQ(graph.Optimize().size(), 1u);
  for (int i = 0; i <= kSteps; ++i) {
    ASSERT_LT((graph.node(i).ToVector() - before.node(i).ToVector()).norm(), 1e-6) << i;
  }
}

TEST(PoseGraph, DoesNotJudgeLoopsWithoutASolution) {
  PoseGraph graph = Straight(5);
  graph.AddEdge(Edge(0, 4, {0, {9, 0, 0}}, true, Variance(0.01, 0.01)));
  const double none = std::numeric_limits<double>::quiet_NaN();
  graph.AddEdge(Edge(0, 5, {0, {none, 0, 0}}, false, Variance(0.1, 0.01)));
  EXPECT_TRUE(graph.Optimize().empty());
  EXPECT_EQ(graph.edges().size(), 7u);
  EXPECT_EQ(graph.node(5).translation.x(), 5);
}

// A correction of the first edge would rotate all others if the first node were fixed.
TEST(PoseGraph, DoesNotMoveAsAWhole) {
  PoseGraph graph = Straight(20);
  graph.AddEdge(Edge(0, 1, {0.02, {1, 0, 0}}, true, Variance(0.1, 1e-4)));
  EXPECT_TRUE(graph.Optimize().empty());
  EXPECT_NEAR(FromFirst(graph, 20).yaw, 0.02, 1e-3);
  EXPECT_LT((graph.node(20).translation - Eigen::Vector3d(20, 0, 0)).norm(), 0.05);
}

// Far more nodes are added than hold the frame.
TEST(PoseGraph, AdaptsToTheNodesThatHoldTheFrame) {
  PoseGraph graph = Straight(5);
  graph.HoldFrame();
  for (int i = 6; i <= 60; ++i) {
    const LevelTransform step = {0, {i <= 33 ? 1.0 : -1.0, 0.01, 0.01}};
    graph.AddNode(graph.node(i - 1) * step);
    graph.AddEdge(Edge(i - 1, i, step, false, Variance(0.1, 0.01)));
  }
  graph.AddEdge(Edge(5, 60, {0, {1, 0, 0}}, true, Variance(0.01, 0.001)));
  EXPECT_TRUE(graph.Optimize().empty());
  EXPECT_GT((graph.node(60).translation - Eigen::Vector3d(6, 0.55, 0.55)).norm(), 0.5);
  for (int i = 0; i <= 5; ++i) {
    EXPECT_LT((graph.node(i).translation - Eigen::Vector3d(i, 0, 0)).norm(), 0.01) << i;
  }
}

TEST(PoseGraph, MovesANodeWithThoseThatAreSeenFromIt) {
  PoseGraph graph = Straight(4);
  graph.Remove(2, 3);
  graph.SetNode(3, {M_PI / 2, {3, 0, 7}});
  EXPECT_LT((graph.node(3).translation - Eigen::Vector3d(3, 0, 7)).norm(), 1e-12);
  EXPECT_LT((graph.node(2).translation - Eigen::Vector3d(3, -1, 7)).norm(), 1e-12);
  EXPECT_EQ(graph.node(4).translation.x(), 4);
}

TEST(PoseGraph, NodesAsMeasuredAreAMinimum) {
  PoseGraph graph = Straight(4);
  graph.AddEdge(Edge(0, 4, {0, {4, 0.1, 0}}, true, Variance(0.1, 0.01)));
  graph.SetNode(2, {0.3, {2, 1, 1}});
  const PoseGraph before = graph;
  graph.TakeNodesAsMeasured();
  EXPECT_TRUE(graph.Optimize().empty());
  for (int i = 0; i <= 4; ++i) {
    EXPECT_LT((graph.node(i).ToVector() - before.node(i).ToVector()).norm(), 1e-9) << i;
  }
  for (size_t i = 0; i < graph.edges().size(); ++i) {
    EXPECT_NEAR(graph.Deviations(graph.edges()[i]), 0, 1e-9);
    EXPECT_EQ(graph.edges()[i].covariance, before.edges()[i].covariance);
  }
}

TEST(PoseGraph, KeepsUnconnectedPartsApart) {
  PoseGraph graph = Straight(2);
  graph.AddNode({1.0, {50, 0, 0}});
  graph.AddNode({1.0, {50, 1, 0}});
  graph.AddEdge(Edge(3, 4, {0, {0, 2, 0}}, false, Variance(0.1, 0.01)));
  EXPECT_TRUE(graph.AreConnected(0, 2));
  EXPECT_FALSE(graph.AreConnected(2, 3));
  EXPECT_EQ(graph.FirstConnected(), (std::vector<int>{0, 0, 0, 3, 3}));
  graph.Optimize();
  EXPECT_NEAR(graph.node(3).translation.y() + graph.node(4).translation.y(), 1, 1e-6);  // as before
  EXPECT_NEAR((graph.node(4).translation - graph.node(3).translation).norm(), 2, 1e-6);
  EXPECT_TRUE(std::isinf(graph.Distance(0, 4)));
}

TEST(PoseGraph, MovesOnePartOnly) {
  PoseGraph graph = Straight(2);
  graph.AddNode({0, {50, 0, 0}});
  graph.MovePart(1, {0, {0, 0, 7}});
  EXPECT_EQ(graph.node(0).translation.z(), 7);
  EXPECT_EQ(graph.node(2).translation.z(), 7);
  EXPECT_EQ(graph.node(3).translation.z(), 0);
}

TEST(PoseGraph, PathLengthIgnoresLoops) {
  PoseGraph graph = Straight(10);
  EXPECT_NEAR(graph.Distance(0, 9), 9, 1e-12);
  graph.AddEdge(Edge(1, 8, {0, {7, 0, 0}}, true, Variance(0.1, 0.01)));
  EXPECT_NEAR(graph.Distance(0, 9), 2, 1e-12);
}

TEST(PoseGraph, WrapsYawDifferences) {
  PoseGraph graph;
  graph.AddNode({3.1, {0, 0, 0}});
  graph.AddNode({-3.1, {0, 0, 0}});
  const LevelEdge edge = Edge(0, 1, {2 * M_PI - 6.2, {0, 0, 0}}, true, Variance(0.1, 0.01));
  EXPECT_NEAR(graph.Deviations(edge), 0, 1e-9);
  graph.AddEdge(edge);
  EXPECT_TRUE(graph.Optimize().empty());
  EXPECT_NEAR(graph.node(1).yaw, -3.1, 1e-6);
}

TEST(PoseGraph, TransfersEdgesOfARemovedNodeToItsNeighbors) {
  PoseGraph graph = Straight(4);
  graph.AddEdge(Edge(0, 2, {0, {2, 0, 0}}, true, Variance(0.3, 0.01)));
  graph.Remove(2, 0);
  EXPECT_FALSE(graph.Has(2));
  EXPECT_EQ(graph.Kept(), (std::vector<int>{0, 1, 3, 4}));
  ASSERT_EQ(graph.edges().size(), 4u);
  const LevelEdge& step = graph.edges()[2];
  EXPECT_EQ(step.from, 1);
  EXPECT_EQ(step.to, 3);
  EXPECT_FALSE(step.is_loop);
  EXPECT_NEAR(step.T_from_to.translation.x(), 2, 1e-12);
  EXPECT_NEAR(step.covariance(0, 0), 2 * 0.01, 1e-12);
  EXPECT_TRUE(graph.edges()[3].is_loop);
  EXPECT_NEAR(graph.edges()[3].way, 1, 1e-12);  // from 2 to 1, its new node
  EXPECT_TRUE(graph.AreConnected(2, 4));
}

TEST(PoseGraph, OdometryEdgesStayOdometryEdgesWhenTransferred) {
  PoseGraph graph = Straight(4);
  graph.AddEdge(Edge(0, 2, {0, {2, 0, 0}}, true, Variance(0.001, 0.001)));
  graph.Remove(2, 0);
  EXPECT_EQ(std::count_if(graph.edges().begin(), graph.edges().end(),
                          [](const LevelEdge& edge) { return !edge.is_loop; }),
            3);
}

TEST(PoseGraph, KeepsTheMoreCertainOfParallelEdges) {
  PoseGraph graph = Straight(3);
  graph.AddEdge(Edge(0, 2, {0, {2, 0, 0}}, true, Variance(0.3, 0.1)));
  graph.AddEdge(Edge(0, 3, {0, {3, 0, 0}}, true, Variance(0.5, 0.1)));
  graph.Remove(2, 0);  // its loop is transferred to 1 or 3
  graph.Remove(1, 0);
  size_t loops = 0;
  for (const LevelEdge& edge : graph.edges()) loops += edge.is_loop;
  EXPECT_EQ(loops, 1u);
  EXPECT_EQ(graph.edges().size(), 2u);  // and the odometry edges
}

TEST(PoseGraph, RemovedNodesKeepTheirPoses) {
  PoseGraph graph = Straight(4);
  graph.Remove(2, 3);
  graph.Remove(3, 1);  // the anchor of another node
  EXPECT_NEAR(graph.node(2).translation.x(), 2, 1e-12);
  const double before = graph.node(2).translation.z();
  graph.MovePart(0, {0, {0, 0, 5}});
  EXPECT_NEAR(graph.node(2).translation.z() - before, 5, 1e-12);
}

// After a removal, indices in the graph differ from node numbers.
TEST(PoseGraph, RemovedNodesDoNotAffectTheRest) {
  PoseGraph graph = Straight(6);
  graph.AddEdge(Edge(0, 6, {0.02, {6, 0, 0.1}}, true, Variance(0.1, 0.01)));
  graph.AddNode({1.0, {50, 0, 0}});
  for (const int number : {2, 3, 0}) graph.Remove(number, 1);
  const std::vector<int> kept = {1, 4, 5, 6, 7};
  PoseGraph rest;
  for (const int number : kept) rest.AddNode(graph.node(number));
  const auto new_number = [&](int number) {
    return static_cast<int>(std::find(kept.begin(), kept.end(), number) - kept.begin());
  };
  for (LevelEdge edge : graph.edges()) {
    edge.from = new_number(edge.from);
    edge.to = new_number(edge.to);
    rest.AddEdge(edge);
  }
  EXPECT_TRUE(graph.Optimize().empty());
  EXPECT_TRUE(rest.Optimize().empty());
  for (const int number : kept) {
    const int other = new_number(number);
    EXPECT_EQ(graph.node(number).ToVector(), rest.node(other).ToVector()) << number;
    EXPECT_EQ(graph.Distance(4, number), rest.Distance(1, other)) << number;
    EXPECT_EQ(graph.AreConnected(4, number), rest.AreConnected(1, other)) << number;
  }
  EXPECT_EQ(graph.ConnectedWith(7),
            (std::vector<bool>{false, false, false, false, false, false, false, true}));
  graph.MovePart(7, {0, {0, 0, 3}});
  EXPECT_EQ(graph.node(7).translation.z(), rest.node(4).translation.z() + 3);
  EXPECT_EQ(graph.node(6).translation.z(), rest.node(3).translation.z());
  EXPECT_NEAR((graph.node(2).translation - graph.node(1).translation).norm(), 1, 1e-12);
}

// Removing a node of the chain preserves the optimum, since the transferred edges are equivalent.
TEST(PoseGraph, OptimumOfTheRestIsUnchangedWithoutANode) {
  PoseGraph all = Straight(4);
  all.AddEdge(Edge(0, 4, {0, {4, 0, 0.05}}, true, Variance(0.1, 0.01)));
  PoseGraph without = all;
  without.Remove(2, 1);
  all.Optimize();
  without.Optimize();
  for (const int node : {1, 3, 4}) {
    EXPECT_LT((all.node(node).ToVector() - without.node(node).ToVector()).norm(), 1e-5) << node;
  }
}

}  // namespace
}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/graph/level_edge.h"

namespace plm_vins {

// Keyframes in the map M with four degrees of freedom each, and what was measured between them.
// A node is T_M_L of its keyframe. Parts that no edge connects lie apart, each where its first
// node is. Deterministic.
class PoseGraph {
 public:
  // Returns the node's number: they count up from zero.
  int AddNode(const LevelTransform& T_M_L);
  void AddEdge(const LevelEdge& edge) { edges_.push_back(edge); }

  // Takes the nodes to where all edges fit best. The first node of each part stays. Loops count
  // robustly; those that are off by more than kThreeSigma in the end are taken out, the worst
  // first, and it is done again. Returns them.
  std::vector<LevelEdge> Optimize();

  // Whether edges lead from one node to the other.
  bool AreConnected(int a, int b) const;
  std::vector<bool> ConnectedWith(int node) const;  // by node

  // Moves all nodes that are connected with `node`.
  void MovePart(int node, const LevelTransform& T_new_old);

  // Length of the shortest way along the edges [m], a loop being no way at all: what odometry may
  // have drifted over. Infinite where there is none.
  double Distance(int from, int to) const;

  // Of an edge, by its own covariance [standard deviations].
  double Deviations(const LevelEdge& edge) const;

  int size() const { return static_cast<int>(nodes_.size()); }
  const LevelTransform& node(int number) const { return nodes_[number]; }
  const std::vector<LevelTransform>& nodes() const { return nodes_; }
  const std::vector<LevelEdge>& edges() const { return edges_; }

 private:
  std::vector<int> Parts() const;  // by node: the first node of its part
  void Solve();

  std::vector<LevelTransform> nodes_;
  std::vector<LevelEdge> edges_;
};

}  // namespace plm_vins

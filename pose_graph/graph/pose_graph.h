// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/graph/level_edge.h"

namespace plm_vins {

// Keyframes in the map M with four degrees of freedom each, and what was measured between them.
// A node is T_M_L of its keyframe. Nodes that are not needed any more can be taken out, and what
// was measured to them is kept between the others. Parts that no edge connects lie apart.
// Deterministic.
class PoseGraph {
 public:
  // Returns the node's number: they count up from zero.
  int AddNode(const LevelTransform& T_M_L);
  void AddEdge(const LevelEdge& edge) { edges_.push_back(edge); }

  // Takes a node out. Its edges are told of that neighbour which it is tied to best instead; of two
  // edges that then join the same nodes the surer one stays, since both are mostly of the same
  // landmarks. node() goes on telling where it was, as seen from `anchor`, one of its part.
  void Remove(int number, int anchor);
  bool Has(int number) const { return nodes_[number].anchor < 0; }
  std::vector<int> Kept() const;  // the numbers of those that are not taken out, in order

  // From now on the nodes that are connected with the first one hold the frame M: what comes to
  // them later adapts to it. They may still move against each other.
  void HoldFrame();

  // Takes the nodes to where all edges fit best. Each part stays where it is: by its nodes that
  // hold the frame or, where it has none, as a whole.
  // Loops count robustly; those that are off by more than kThreeSigmaOf4Dof in the end are taken
  // out, the worst first, and it is done again from the beginning. Returns them. As long as the
  // solver does not get to the end, no loop is judged.
  std::vector<LevelEdge> Optimize();

  // Takes a node, which is not taken out, to a place that is known better. Those that are seen from
  // it follow.
  void SetNode(int number, const LevelTransform& T_M_L) { nodes_[number].T_M_L = T_M_L; }

  // Takes what lies between the nodes now for what was measured, as surely as before: Optimize()
  // leaves them there.
  void TakeNodesAsMeasured();

  // Whether edges lead from one node to the other.
  bool AreConnected(int a, int b) const;
  std::vector<bool> ConnectedWith(int node) const;  // by node
  std::vector<int> FirstConnected() const;          // by node: the first that is connected with it

  // Moves all nodes that are connected with `node`.
  void MovePart(int node, const LevelTransform& T_new_old);

  // Length of the shortest way along the edges [m], a loop being no way at all: what odometry may
  // have drifted over. Infinite where there is none.
  double Distance(int from, int to) const;

  // Of an edge, by its own covariance [standard deviations].
  double Deviations(const LevelEdge& edge) const;

  int size() const { return static_cast<int>(nodes_.size()); }  // with those taken out
  LevelTransform node(int number) const;
  const std::vector<LevelEdge>& edges() const { return edges_; }

 private:
  struct Node {
    LevelTransform T_M_L;  // of one that is taken out: T_A_L, A being its anchor's L
    int anchor = -1;       // -1: it is not taken out
    int place = -1;        // in `kept_`, if it is not taken out
    bool holds_frame = false;
  };
  struct KeptNode {
    int number = -1;
    std::vector<int> anchored;  // those that are seen from it
  };

  // Where in `kept_` a node is, or its anchor.
  int PlaceOf(int number) const;
  void Anchor(int number, int anchor);
  void AddSurer(const LevelEdge& edge);
  std::vector<int> Parts() const;        // by place: that of the first node of its part
  std::vector<Vector4d> Values() const;  // by place: of T_M_L
  void Place(const std::vector<Vector4d>& values);
  bool Solve();  // whether the solver got to the end
  void TakeOver(const std::vector<Vector4d>& values, const std::vector<int>& parts);

  std::vector<Node> nodes_;
  // Those that are not taken out, in order: what is done with each keyframe looks at these alone,
  // so that it takes no longer the more there have been.
  std::vector<KeptNode> kept_;
  std::vector<LevelEdge> edges_;
};

}  // namespace plm_vins

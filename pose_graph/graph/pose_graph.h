// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/graph/level_edge.h"

namespace plm_vins {

// Four-degree-of-freedom pose graph over keyframes in the map M. A node is the pose T_M_L of its
// keyframe. Nodes can be removed; their edges are then transferred to the remaining nodes. Nodes
// that no path of edges connects belong to different parts. Deterministic.
class PoseGraph {
 public:
  // Returns the node's number, counted from zero.
  int AddNode(const LevelTransform& T_M_L);
  void AddEdge(const LevelEdge& edge) { edges_.push_back(edge); }

  // Removes a node. Its edges are transferred to its most certain neighbor. If two edges then
  // connect the same nodes, the one with the smaller covariance stays, since both derive mostly
  // from the same landmarks. node() still returns the removed node's pose, which is fixed relative
  // to `anchor`, a node of the same part.
  void Remove(int number, int anchor);
  bool Has(int number) const { return nodes_[number].anchor < 0; }
  std::vector<int> Kept() const;  // numbers of the nodes that were not removed, in ascending order

  // Makes the nodes that are now connected with the first one hold the frame M: nodes that are
  // connected later are aligned with them. Their relative poses can still change.
  void HoldFrame();

  // Optimizes all nodes. Each part is kept in place by its nodes that hold the frame, or as a whole
  // if it has none. Loops have a robust loss. Loops whose residual exceeds kThreeSigmaOf4Dof are
  // dropped, the worst first, and the optimization is repeated from the start. Returns the dropped
  // loops. No loop is dropped unless the solver converges.
  std::vector<LevelEdge> Optimize();

  // Sets the pose of a node that was not removed. Nodes anchored at it move along.
  void SetNode(int number, const LevelTransform& T_M_L) { nodes_[number].T_M_L = T_M_L; }

  // Sets all measurements to the current relative poses, with unchanged covariances, so that
  // Optimize() leaves the nodes there.
  void TakeNodesAsMeasured();

  // Returns whether a path of edges connects the two nodes.
  bool AreConnected(int a, int b) const;
  std::vector<bool> ConnectedWith(int node) const;  // flags by node
  std::vector<int> FirstConnected() const;          // first node connected with each node

  // Moves all nodes that are connected with `node`.
  void MovePart(int node, const LevelTransform& T_new_old);

  // Length of the shortest path along the edges [m], over which odometry may have drifted; loops
  // have length zero. Infinite if there is no path.
  double Distance(int from, int to) const;

  // Mahalanobis distance of the edge's residual by its own covariance [standard deviations].
  double Deviations(const LevelEdge& edge) const;

  int size() const { return static_cast<int>(nodes_.size()); }  // including removed nodes
  LevelTransform node(int number) const;
  const std::vector<LevelEdge>& edges() const { return edges_; }

 private:
  struct Node {
    LevelTransform T_M_L;  // T_A_L of a removed node, where A is its anchor's L
    int anchor = -1;       // -1 if not removed
    int place = -1;        // index in `kept_`, if not removed
    bool holds_frame = false;
  };
  struct KeptNode {
    int number = -1;
    std::vector<int> anchored;  // removed nodes relative to this one
  };

  // Index in `kept_` of a node, or of its anchor if it was removed.
  int PlaceOf(int number) const;
  void Anchor(int number, int anchor);
  void AddSurer(const LevelEdge& edge);
  std::vector<int> Parts() const;        // first node of the part of each node in `kept_`
  std::vector<Vector4d> Values() const;  // T_M_L of each node in `kept_`
  void Place(const std::vector<Vector4d>& values);
  bool Solve();  // returns whether the solver converged
  void TakeOver(const std::vector<Vector4d>& values, const std::vector<int>& parts);

  std::vector<Node> nodes_;
  // Nodes that were not removed, in ascending order. The work for each keyframe is proportional to
  // their number, not to that of all nodes ever added.
  std::vector<KeptNode> kept_;
  std::vector<LevelEdge> edges_;
};

}  // namespace plm_vins

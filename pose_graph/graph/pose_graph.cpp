// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph/pose_graph.h"

#include <ceres/ceres.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {
namespace {

constexpr int kMaxIterations = 50;  // a few suffice from the previous solution
// A huge trust region makes steps pure Gauss-Newton as long as the cost decreases. Ceres' default
// converges slowly on long chains of edges, which bend easily as a whole.
constexpr double kTrustRegion = 1e12;

// Whitened residual of an edge. The parameters of a node are (x, y, z, yaw) of T_M_L.
struct EdgeCost {
  template <typename T>
  bool operator()(const T* from, const T* to, T* residual) const {
    using std::cos;  // for Jets, argument-dependent lookup finds those of Ceres
    using std::sin;
    const T c = cos(from[3]);
    const T s = sin(from[3]);
    const T dx = to[0] - from[0];
    const T dy = to[1] - from[1];
    Eigen::Matrix<T, 4, 1> error;
    error << c * dx + s * dy - measured(0), -s * dx + c * dy - measured(1),
        to[2] - from[2] - measured(2), to[3] - from[3] - measured(3);
    error(3) -= T(2 * M_PI * turns);
    Eigen::Map<Eigen::Matrix<T, 4, 1>>{residual} = whitening.cast<T>() * error;
    return true;
  }
  Vector4d measured;
  Matrix4d whitening;
  double turns;  // full turns to subtract from the difference of the yaws
};

}  // namespace

int PoseGraph::AddNode(const LevelTransform& T_M_L) {
  const int number = size();
  nodes_.push_back({T_M_L, -1, static_cast<int>(kept_.size())});
  kept_.push_back({number, {}});
  return number;
}

int PoseGraph::PlaceOf(int number) const {
  const Node& node = nodes_[number];
  return node.anchor < 0 ? node.place : nodes_[node.anchor].place;
}

LevelTransform PoseGraph::node(int number) const {
  const Node& node = nodes_[number];
  return node.anchor < 0 ? node.T_M_L : nodes_[node.anchor].T_M_L * node.T_M_L;
}

void PoseGraph::Remove(int number, int anchor) {
  std::vector<LevelEdge> from_node;
  std::vector<LevelEdge> others;
  for (const LevelEdge& edge : edges_) {
    if (edge.from == number) {
      from_node.push_back(edge);
    } else if (edge.to == number) {
      from_node.push_back(Reversed(edge));
    } else {
      others.push_back(edge);
    }
  }
  edges_ = std::move(others);
  // Odometry edges are preferred: odometry edges chained through a loop would be lost with it if it
  // is dropped.
  const auto rank = [](const LevelEdge& edge) {
    return std::make_pair(edge.is_loop, edge.covariance.determinant());
  };
  const auto best =
      std::min_element(from_node.begin(), from_node.end(),
                       [&](const LevelEdge& a, const LevelEdge& b) { return rank(a) < rank(b); });
  for (auto edge = from_node.begin(); edge != from_node.end(); ++edge) {
    if (edge->to != best->to) AddSurer(Chained(Reversed(*best), *edge));
  }
  Anchor(number, anchor);
}

// Every removed node is anchored at a kept one, so the chain needs no search.
void PoseGraph::Anchor(int number, int anchor) {
  const LevelTransform T_A_L = node(anchor).Inverse() * node(number);
  const auto removed = kept_.begin() + PlaceOf(number);
  std::vector<int>& anchored = kept_[PlaceOf(anchor)].anchored;
  for (const int other : removed->anchored) {
    nodes_[other] = {T_A_L * nodes_[other].T_M_L, anchor};
    anchored.push_back(other);
  }
  nodes_[number] = {T_A_L, anchor};
  anchored.push_back(number);
  for (auto next = kept_.erase(removed); next != kept_.end(); ++next) --nodes_[next->number].place;
}

// Odometry edges and loops are each compared with their own kind only, since odometry edges are
// never dropped.
void PoseGraph::AddSurer(const LevelEdge& edge) {
  const auto same = std::find_if(edges_.begin(), edges_.end(), [&](const LevelEdge& other) {
    return edge.is_loop == other.is_loop &&
           std::minmax(edge.from, edge.to) == std::minmax(other.from, other.to);
  });
  if (same == edges_.end()) {
    edges_.push_back(edge);
  } else if (edge.covariance.determinant() < same->covariance.determinant()) {
    *same = edge;
  }
}

std::vector<int> PoseGraph::Kept() const {
  std::vector<int> numbers;
  numbers.reserve(kept_.size());
  for (const KeptNode& kept : kept_) numbers.push_back(kept.number);
  return numbers;
}

void PoseGraph::HoldFrame() {
  const std::vector<bool> connected = ConnectedWith(0);
  for (int i = 0; i < size(); ++i) nodes_[i].holds_frame = connected[i];
}

void PoseGraph::TakeNodesAsMeasured() {
  for (LevelEdge& edge : edges_) edge.T_from_to = node(edge.from).Inverse() * node(edge.to);
}

double PoseGraph::Deviations(const LevelEdge& edge) const {
  const LevelTransform actual = node(edge.from).Inverse() * node(edge.to);
  return plm_vins::Deviations(EdgeError(edge.T_from_to, actual), edge.covariance);
}

std::vector<LevelEdge> PoseGraph::Optimize() {
  std::vector<LevelEdge> dropped;
  const std::vector<Vector4d> before = Values();
  while (Solve()) {
    auto worst = edges_.end();
    double worst_deviations = kThreeSigmaOf4Dof;
    for (auto edge = edges_.begin(); edge != edges_.end(); ++edge) {
      const double deviations = edge->is_loop ? Deviations(*edge) : 0;
      if (deviations <= worst_deviations) continue;
      worst = edge;
      worst_deviations = deviations;
    }
    if (worst == edges_.end()) return dropped;
    dropped.push_back(*worst);
    edges_.erase(worst);
    Place(before);  // resets to the values that the dropped loop has not distorted
  }
  return dropped;
}

std::vector<Vector4d> PoseGraph::Values() const {
  std::vector<Vector4d> values;
  values.reserve(kept_.size());
  for (const KeptNode& kept : kept_) values.push_back(nodes_[kept.number].T_M_L.ToVector());
  return values;
}

void PoseGraph::Place(const std::vector<Vector4d>& values) {
  for (size_t i = 0; i < kept_.size(); ++i) {
    nodes_[kept_[i].number].T_M_L = LevelTransform::FromVector(values[i]);
  }
}

bool PoseGraph::Solve() {
  std::vector<Vector4d> values = Values();
  ceres::Problem problem;
  for (const LevelEdge& edge : edges_) {
    const Vector4d measured = edge.T_from_to.ToVector();
    Vector4d& from = values[PlaceOf(edge.from)];
    Vector4d& to = values[PlaceOf(edge.to)];
    const double excess = to(3) - from(3) - measured(3);
    auto* cost = new ceres::AutoDiffCostFunction<EdgeCost, 4, 4, 4>(
        new EdgeCost{measured, Whitening(edge.covariance), std::round(excess / (2 * M_PI))});
    // The loss has the scale of the test that drops loops: after a jump of odometry, a correct loop
    // has a large residual at first, and must pull the graph before it is tested.
    problem.AddResidualBlock(cost,
                             edge.is_loop ? new ceres::CauchyLoss(kThreeSigmaOf4Dof) : nullptr,
                             from.data(), to.data());
  }
  const std::vector<int> parts = Parts();
  for (size_t i = 0; i < values.size(); ++i) {
    if (parts[i] == static_cast<int>(i) && problem.HasParameterBlock(values[i].data())) {
      problem.SetParameterBlockConstant(values[i].data());
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  // Eigen's solver is single-threaded; SuiteSparse wakes other threads, which costs more than it
  // gains.
  if (ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::EIGEN_SPARSE)) {
    options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  }
  options.max_num_iterations = kMaxIterations;
  options.initial_trust_region_radius = kTrustRegion;
  options.num_threads = 1;  // multithreaded sums are not reproducible
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return false;
  TakeOver(values, parts);
  return summary.termination_type == ceres::CONVERGENCE;
}

// The solver holds the first node of each part fixed, which would rotate the whole part by any
// change of its first edge. So each part is aligned with its previous poses: by its nodes that hold
// the frame, or by all if there are none.
void PoseGraph::TakeOver(const std::vector<Vector4d>& values, const std::vector<int>& parts) {
  std::map<int, LevelFit> fits;
  std::map<int, LevelFit> fits_of_all;
  for (size_t i = 0; i < kept_.size(); ++i) {
    const Node& node = nodes_[kept_[i].number];
    const LevelTransform solved = LevelTransform::FromVector(values[i]);
    if (node.holds_frame) fits[parts[i]].Add(solved, node.T_M_L);
    fits_of_all[parts[i]].Add(solved, node.T_M_L);
  }
  fits.merge(fits_of_all);
  for (size_t i = 0; i < kept_.size(); ++i) {
    nodes_[kept_[i].number].T_M_L =
        fits[parts[i]].Transform() * LevelTransform::FromVector(values[i]);
  }
}

std::vector<int> PoseGraph::Parts() const {
  std::vector<int> part(kept_.size());
  std::iota(part.begin(), part.end(), 0);
  const auto first_of = [&](int place) {
    while (part[place] != place) place = part[place] = part[part[place]];
    return place;
  };
  for (const LevelEdge& edge : edges_) {
    const auto [low, high] =
        std::minmax({first_of(PlaceOf(edge.from)), first_of(PlaceOf(edge.to))});
    part[high] = low;
  }
  for (int& place : part) place = first_of(place);
  return part;
}

bool PoseGraph::AreConnected(int a, int b) const {
  const std::vector<int> parts = Parts();
  return parts[PlaceOf(a)] == parts[PlaceOf(b)];
}

std::vector<int> PoseGraph::FirstConnected() const {
  const std::vector<int> parts = Parts();
  std::vector<int> first;
  first.reserve(nodes_.size());
  for (int i = 0; i < size(); ++i) first.push_back(kept_[parts[PlaceOf(i)]].number);
  return first;
}

std::vector<bool> PoseGraph::ConnectedWith(int node) const {
  const std::vector<int> first = FirstConnected();
  std::vector<bool> connected;
  connected.reserve(nodes_.size());
  for (const int other : first) connected.push_back(other == first[node]);
  return connected;
}

void PoseGraph::MovePart(int node, const LevelTransform& T_new_old) {
  const std::vector<int> parts = Parts();
  for (size_t i = 0; i < kept_.size(); ++i) {
    if (parts[i] != parts[PlaceOf(node)]) continue;
    LevelTransform& T_M_L = nodes_[kept_[i].number].T_M_L;
    T_M_L = T_new_old * T_M_L;
  }
}

double PoseGraph::Distance(int from, int to) const {
  std::vector<std::vector<std::pair<int, double>>> neighbors(kept_.size());  // by index in `kept_`
  for (const LevelEdge& edge : edges_) {
    neighbors[PlaceOf(edge.from)].emplace_back(PlaceOf(edge.to), edge.way);
    neighbors[PlaceOf(edge.to)].emplace_back(PlaceOf(edge.from), edge.way);
  }
  std::vector<double> distances(kept_.size(), std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, int>;  // distance, index in `kept_`
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  distances[PlaceOf(from)] = 0;
  front.emplace(0, PlaceOf(from));
  while (!front.empty() && front.top().second != PlaceOf(to)) {
    const auto [distance, place] = front.top();
    front.pop();
    if (distance > distances[place]) continue;
    for (const auto& [next, length] : neighbors[place]) {
      if (distance + length >= distances[next]) continue;
      distances[next] = distance + length;
      front.emplace(distances[next], next);
    }
  }
  return distances[PlaceOf(to)];
}

}  // namespace plm_vins

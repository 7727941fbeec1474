// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph/pose_graph.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace plm_vins {
namespace {

constexpr double kRobustWidth = 1.0;  // [standard deviations]
constexpr int kMaxIterations = 10;    // from the last solution, few do

// W with W^T W = covariance^-1.
Matrix4d Whitening(const Matrix4d& covariance) {
  const Eigen::LLT<Matrix4d> factor(covariance);
  return factor.matrixL().solve(Matrix4d::Identity());
}

// The whitened error of an edge. The variables of a node: (x, y, z, yaw) of T_M_L.
struct EdgeCost {
  template <typename T>
  bool operator()(const T* from, const T* to, T* residual) const {
    using ceres::cos;
    using ceres::sin;
    using std::cos;
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
  double turns;  // full ones, by which the yaws differ more than was measured
};

}  // namespace

double Deviations(const Vector4d& error, const Matrix4d& covariance) {
  return (Whitening(covariance) * error).norm();
}

int PoseGraph::AddNode(const LevelTransform& T_M_L) {
  nodes_.push_back(T_M_L);
  return size() - 1;
}

double PoseGraph::Deviations(const LevelEdge& edge) const {
  const LevelTransform actual = nodes_[edge.from].Inverse() * nodes_[edge.to];
  return plm_vins::Deviations(EdgeError(edge.T_from_to, actual), edge.covariance);
}

std::vector<LevelEdge> PoseGraph::Optimize() {
  std::vector<LevelEdge> dropped;
  while (true) {
    Solve();
    auto worst = edges_.end();
    double worst_deviations = kThreeSigma;
    for (auto edge = edges_.begin(); edge != edges_.end(); ++edge) {
      const double deviations = edge->is_loop ? Deviations(*edge) : 0;
      if (deviations <= worst_deviations) continue;
      worst = edge;
      worst_deviations = deviations;
    }
    if (worst == edges_.end()) return dropped;
    dropped.push_back(*worst);
    edges_.erase(worst);
  }
}

void PoseGraph::Solve() {
  std::vector<Vector4d> values;
  for (const LevelTransform& node : nodes_) values.push_back(node.ToVector());
  ceres::Problem problem;
  for (const LevelEdge& edge : edges_) {
    const Vector4d measured = edge.T_from_to.ToVector();
    const double excess = values[edge.to](3) - values[edge.from](3) - measured(3);
    auto* cost = new ceres::AutoDiffCostFunction<EdgeCost, 4, 4, 4>(
        new EdgeCost{measured, Whitening(edge.covariance), std::round(excess / (2 * M_PI))});
    problem.AddResidualBlock(cost, edge.is_loop ? new ceres::CauchyLoss(kRobustWidth) : nullptr,
                             values[edge.from].data(), values[edge.to].data());
  }
  const std::vector<int> parts = Parts();
  for (int i = 0; i < size(); ++i) {
    if (parts[i] == i && problem.HasParameterBlock(values[i].data())) {
      problem.SetParameterBlockConstant(values[i].data());
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMaxIterations;
  options.num_threads = 1;  // sums of several would differ from run to run
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return;
  for (int i = 0; i < size(); ++i) nodes_[i] = LevelTransform::FromVector(values[i]);
}

std::vector<int> PoseGraph::Parts() const {
  std::vector<int> part(nodes_.size());
  std::iota(part.begin(), part.end(), 0);
  const auto first_of = [&](int node) {
    while (part[node] != node) node = part[node] = part[part[node]];
    return node;
  };
  for (const LevelEdge& edge : edges_) {
    const auto [low, high] = std::minmax({first_of(edge.from), first_of(edge.to)});
    part[high] = low;
  }
  for (int i = 0; i < size(); ++i) part[i] = first_of(i);
  return part;
}

bool PoseGraph::AreConnected(int a, int b) const {
  const std::vector<int> parts = Parts();
  return parts[a] == parts[b];
}

std::vector<bool> PoseGraph::ConnectedWith(int node) const {
  const std::vector<int> parts = Parts();
  std::vector<bool> connected;
  for (const int part : parts) connected.push_back(part == parts[node]);
  return connected;
}

void PoseGraph::MovePart(int node, const LevelTransform& T_new_old) {
  const std::vector<bool> moves = ConnectedWith(node);
  for (int i = 0; i < size(); ++i) {
    if (moves[i]) nodes_[i] = T_new_old * nodes_[i];
  }
}

double PoseGraph::Distance(int from, int to) const {
  std::vector<std::vector<std::pair<int, double>>> neighbours(nodes_.size());
  for (const LevelEdge& edge : edges_) {
    const double length = edge.is_loop ? 0 : edge.T_from_to.translation.norm();
    neighbours[edge.from].emplace_back(edge.to, length);
    neighbours[edge.to].emplace_back(edge.from, length);
  }
  std::vector<double> distances(nodes_.size(), std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, int>;  // distance, node
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  distances[from] = 0;
  front.emplace(0, from);
  while (!front.empty() && front.top().second != to) {
    const auto [distance, node] = front.top();
    front.pop();
    if (distance > distances[node]) continue;
    for (const auto& [next, length] : neighbours[node]) {
      if (distance + length >= distances[next]) continue;
      distances[next] = distance + length;
      front.emplace(distances[next], next);
    }
  }
  return distances[to];
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/marginalization_prior.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace plm_vins {

Quadratic MarginalizeFirst(const Quadratic& quadratic, int count) {
  const int rest = static_cast<int>(quadratic.b.size()) - count;
  // Eigen's solver accesses the first element, so empty systems are handled separately.
  if (count == 0) return quadratic;
  if (rest == 0) return {Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)};
  const auto H_mr = quadratic.H.topRightCorner(count, rest);

  // Scaled to a unit diagonal: meters, radians and biases differ by many orders of magnitude.
  const Eigen::VectorXd diagonal = quadratic.H.diagonal().head(count);
  const Eigen::VectorXd scale =
      (diagonal.array() > 0).select(diagonal.array().max(1e-300).rsqrt(), 0.0);
  const Eigen::MatrixXd H_mm =
      scale.asDiagonal() * quadratic.H.topLeftCorner(count, count) * scale.asDiagonal();
  const Eigen::LDLT<Eigen::MatrixXd> factor(H_mm);
  const Eigen::MatrixXd scaled_H_mr = scale.asDiagonal() * H_mr;
  const Eigen::VectorXd scaled_b_m = scale.asDiagonal() * quadratic.b.head(count);

  Quadratic result;
  result.H = quadratic.H.bottomRightCorner(rest, rest) -
             scaled_H_mr.transpose() * factor.solve(scaled_H_mr);
  result.H = 0.5 * (result.H + result.H.transpose()).eval();
  result.b = quadratic.b.tail(rest) - scaled_H_mr.transpose() * factor.solve(scaled_b_m);
  return result;
}

Quadratic Permute(const Quadratic& quadratic, const std::vector<int>& new_position) {
  const int size = static_cast<int>(quadratic.b.size());
  Quadratic result{Eigen::MatrixXd(size, size), Eigen::VectorXd(size)};
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      result.H(new_position[i], new_position[j]) = quadratic.H(i, j);
    }
    result.b[new_position[j]] = quadratic.b[j];
  }
  return result;
}

MarginalizationPrior::Block MarginalizationPrior::MakeBlock(const BlockId& id, int offset,
                                                            const double* values) {
  MarginalizationPrior::Block block;
  block.id = id;
  block.offset = offset;
  std::copy(values, values + VariableTypeOf(id.kind).ambient_size, block.linearization.begin());
  return block;
}

const double* MarginalizationPrior::Linearization(const BlockId& id) const {
  for (const Block& block : blocks_) {
    if (block.id == id) return block.linearization.data();
  }
  return nullptr;
}

Eigen::VectorXd MarginalizationPrior::Delta(const WindowProblem& problem) const {
  Eigen::VectorXd delta(quadratic_.b.size());
  for (const Block& block : blocks_) {
    const double* values = problem.variables()[problem.Find(block.id)].values;
    VariableTypeOf(block.id.kind).minus(values, block.linearization.data(), &delta[block.offset]);
  }
  return delta;
}

double MarginalizationPrior::Cost(const WindowProblem& problem) const {
  if (empty()) return 0;
  const Eigen::VectorXd delta = Delta(problem);
  return delta.dot(0.5 * (quadratic_.H * delta) + quadratic_.b);
}

double MarginalizationPrior::AddTo(const WindowProblem& problem,
                                   const std::vector<int>& dense_offset, Eigen::MatrixXd* H,
                                   Eigen::VectorXd* b) const {
  if (empty()) return 0;
  const Eigen::VectorXd delta = Delta(problem);
  const Eigen::VectorXd H_delta = quadratic_.H * delta;
  std::vector<int> dense(quadratic_.b.size(), -1);
  for (const Block& block : blocks_) {
    const int offset = dense_offset[problem.Find(block.id)];
    if (offset < 0) continue;
    const int size = VariableTypeOf(block.id.kind).tangent_size;
    for (int i = 0; i < size; ++i) dense[block.offset + i] = offset + i;
  }
  for (size_t j = 0; j < dense.size(); ++j) {
    if (dense[j] < 0) continue;
    for (size_t i = 0; i < dense.size(); ++i) {
      if (dense[i] >= 0 && dense[i] <= dense[j]) (*H)(dense[i], dense[j]) += quadratic_.H(i, j);
    }
    (*b)[dense[j]] += quadratic_.b[j] + H_delta[j];
  }
  return delta.dot(0.5 * H_delta + quadratic_.b);
}

MarginalizationPrior MarginalizationPrior::Marginalize(
    const std::function<bool(const BlockId&)>& drop) const {
  std::vector<Block> kept;
  std::vector<int> new_position(quadratic_.b.size());
  int dropped_size = 0;
  for (const Block& block : blocks_) {
    if (drop(block.id)) dropped_size += VariableTypeOf(block.id.kind).tangent_size;
  }
  if (dropped_size == 0) return *this;
  int next_dropped = 0, next_kept = 0;
  for (const Block& block : blocks_) {
    const bool is_dropped = drop(block.id);
    if (!is_dropped) {
      kept.push_back(block);
      kept.back().offset = next_kept;
    }
    for (int i = 0; i < VariableTypeOf(block.id.kind).tangent_size; ++i) {
      new_position[block.offset + i] = is_dropped ? next_dropped++ : dropped_size + next_kept++;
    }
  }
  return {kept, MarginalizeFirst(Permute(quadratic_, new_position), dropped_size)};
}

}  // namespace plm_vins

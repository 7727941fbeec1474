// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/prior_cost.h"

#include <Eigen/Cholesky>

namespace plm_vins {
namespace {

constexpr double kMinPivot = 1e-13;  // for the scaled matrix; smaller pivots are rounding errors

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

PriorCost::PriorCost(const MarginalizationPrior& prior) : prior_(prior) {
  const Eigen::MatrixXd& H = prior.quadratic().H;
  set_num_residuals(static_cast<int>(H.rows()));
  for (const MarginalizationPrior::Block& block : prior.blocks()) {
    mutable_parameter_block_sizes()->push_back(VariableTypeOf(block.id.kind).ambient_size);
  }
  const Eigen::VectorXd inverse_scale = H.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::VectorXd scale = inverse_scale.cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> factor(scale.asDiagonal() * H * scale.asDiagonal());
  const Eigen::VectorXd root = factor.vectorD().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd inverse_root =
      (factor.vectorD().array() > kMinPivot).select(root.cwiseInverse(), 0.0);
  const Eigen::MatrixXd L = factor.matrixL();
  const Eigen::MatrixXd PT_L = factor.transpositionsP().transpose() * L;
  J_ = root.asDiagonal() * PT_L.transpose() * inverse_scale.asDiagonal();
  const Eigen::VectorXd permuted_b =
      factor.transpositionsP() * scale.cwiseProduct(prior.quadratic().b);
  e_ = inverse_root.cwiseProduct(factor.matrixL().solve(permuted_b));
}

bool PriorCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  const std::vector<MarginalizationPrior::Block>& blocks = prior_.blocks();
  Eigen::VectorXd delta(e_.size());
  for (size_t i = 0; i < blocks.size(); ++i) {
    VariableTypeOf(blocks[i].id.kind)
        .minus(parameters[i], blocks[i].linearization.data(), &delta[blocks[i].offset]);
  }
  Eigen::Map<Eigen::VectorXd>(residuals, e_.size()) = J_ * delta + e_;
  if (jacobians == nullptr) return true;
  for (size_t i = 0; i < blocks.size(); ++i) {
    if (jacobians[i] == nullptr) continue;
    const VariableType& type = VariableTypeOf(blocks[i].id.kind);
    Eigen::Map<RowMajorMatrix> J(jacobians[i], e_.size(), type.ambient_size);
    J.leftCols(type.tangent_size) = J_.middleCols(blocks[i].offset, type.tangent_size);
    J.rightCols(type.ambient_size - type.tangent_size).setZero();
  }
  return true;
}

}  // namespace plm_vins

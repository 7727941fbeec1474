// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/ceres_adapters.h"

#include <Eigen/Cholesky>

namespace plm_vins {
namespace {

constexpr double kMinPivot = 1e-13;  // for the scaled matrix; smaller pivots are rounding errors

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void SetIdentity(int rows, int columns, double* jacobian) {
  Eigen::Map<RowMajorMatrix>(jacobian, rows, columns).setIdentity();
}

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

bool TangentManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  type_.plus(x, delta, x_plus_delta);
  return true;
}

#if PLM_CERES_HAS_MANIFOLD
bool TangentManifold::PlusJacobian(const double* /*x*/, double* jacobian) const {
  SetIdentity(type_.ambient_size, type_.tangent_size, jacobian);
  return true;
}

bool TangentManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  type_.minus(y, x, y_minus_x);
  return true;
}

bool TangentManifold::MinusJacobian(const double* /*x*/, double* jacobian) const {
  SetIdentity(type_.tangent_size, type_.ambient_size, jacobian);
  return true;
}

void SetManifold(ceres::Problem* problem, double* values, const VariableType& type) {
  problem->SetManifold(values, new TangentManifold(type));  // the problem takes ownership
}
#else
bool TangentManifold::ComputeJacobian(const double* /*x*/, double* jacobian) const {
  SetIdentity(type_.ambient_size, type_.tangent_size, jacobian);
  return true;
}

void SetManifold(ceres::Problem* problem, double* values, const VariableType& type) {
  problem->SetParameterization(values, new TangentManifold(type));  // the problem takes ownership
}
#endif

}  // namespace plm_vins

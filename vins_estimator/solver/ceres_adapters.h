// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/version.h>

// Ceres has two interfaces for manifolds: Manifold (since 2.1) and LocalParameterization (before).
#if CERES_VERSION_MAJOR > 2 || (CERES_VERSION_MAJOR == 2 && CERES_VERSION_MINOR >= 1)
#define PLM_CERES_HAS_MANIFOLD 1
#include <ceres/manifold.h>
#else
#define PLM_CERES_HAS_MANIFOLD 0
#include <ceres/local_parameterization.h>
#endif

#include <Eigen/Core>
#include <vector>

#include "vins_estimator/equations/marginalization_prior.h"
#include "vins_estimator/equations/variable.h"
#include "vins_estimator/factors/factor.h"

namespace plm_vins {

// Adapts a Factor to ceres::CostFunction. The factor is not owned.
class FactorCost final : public ceres::CostFunction {
 public:
  // `block_sizes` are the ambient sizes of the factor's variables.
  FactorCost(const Factor* factor, const std::vector<int>& block_sizes) : factor_(factor) {
    set_num_residuals(factor->num_residuals());
    mutable_parameter_block_sizes()->assign(block_sizes.begin(), block_sizes.end());
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    return factor_->Evaluate(parameters, residuals, jacobians);
  }

 private:
  const Factor* factor_;
};

// The marginalization prior 0.5 d^T H d + b^T d as squared residuals, the form that Ceres takes:
//   r = J d + e  with  J^T J = H,  J^T e = b,   so   0.5 |r|^2 = 0.5 d^T H d + b^T d + constant().
// J = D^1/2 L^T P S^-1 from the pivoted Cholesky factors P^T L D L^T P of S H S, where S gives H a
// unit diagonal. Directions in the null space of H (up to rounding) have zero rows. The parameter
// blocks are those of the prior, in its order. Jacobians follow factors/manifolds.h and are
// evaluated at d = 0.
class PriorCost final : public ceres::CostFunction {
 public:
  // `prior` must outlive this object and not be empty.
  explicit PriorCost(const MarginalizationPrior& prior);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

  double constant() const { return 0.5 * e_.squaredNorm(); }

 private:
  const MarginalizationPrior& prior_;
  Eigen::MatrixXd J_;
  Eigen::VectorXd e_;
};

// Manifold of a variable type, in Ceres' interface. The factors' Jacobians are already with respect
// to the tangent (factors/manifolds.h) and padded with zero columns. PlusJacobian() is therefore
// [I; 0], so that Ceres' product of both is the tangent Jacobian itself.
#if PLM_CERES_HAS_MANIFOLD
class TangentManifold final : public ceres::Manifold {
 public:
  explicit TangentManifold(const VariableType& type) : type_(type) {}

  int AmbientSize() const override { return type_.ambient_size; }
  int TangentSize() const override { return type_.tangent_size; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;  // [I, 0]

 private:
  const VariableType type_;
};
#else
class TangentManifold final : public ceres::LocalParameterization {
 public:
  explicit TangentManifold(const VariableType& type) : type_(type) {}

  int GlobalSize() const override { return type_.ambient_size; }
  int LocalSize() const override { return type_.tangent_size; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool ComputeJacobian(const double* x, double* jacobian) const override;  // [I; 0]

 private:
  const VariableType type_;
};
#endif

// Sets the manifold of `values`, a parameter block of `problem`, to that of the variable type.
void SetManifold(ceres::Problem* problem, double* values, const VariableType& type);

}  // namespace plm_vins

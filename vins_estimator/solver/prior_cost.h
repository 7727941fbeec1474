// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>

#include "vins_estimator/equations/marginalization_prior.h"

namespace plm_vins {

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

}  // namespace plm_vins

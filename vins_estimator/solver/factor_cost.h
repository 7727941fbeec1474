// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>

#include <vector>

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

}  // namespace plm_vins

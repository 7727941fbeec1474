// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>

#include <vector>

namespace plm_vins {

// Another cost function with Jacobians taken at first estimates ([Huang2010]) and residuals at the
// values: what TermEvaluation does for the own solver, for Ceres.
class FirstEstimateCost final : public ceres::CostFunction {
 public:
  // `cost` must outlive this object. `linearization`: by parameter block, null where Jacobians are
  // taken at the values.
  FirstEstimateCost(const ceres::CostFunction* cost, std::vector<const double*> linearization);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const ceres::CostFunction* cost_;
  std::vector<const double*> linearization_;
};

}  // namespace plm_vins

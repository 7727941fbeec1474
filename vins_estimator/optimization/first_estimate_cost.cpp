// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/optimization/first_estimate_cost.h"

#include <array>
#include <utility>

#include "vins_estimator/problem/window_problem.h"

namespace plm_vins {

FirstEstimateCost::FirstEstimateCost(const ceres::CostFunction* cost,
                                     std::vector<const double*> linearization)
    : cost_(cost), linearization_(std::move(linearization)) {
  set_num_residuals(cost->num_residuals());
  *mutable_parameter_block_sizes() = cost->parameter_block_sizes();
}

bool FirstEstimateCost::Evaluate(double const* const* parameters, double* residuals,
                                 double** jacobians) const {
  if (jacobians != nullptr) {
    std::array<const double*, ResidualTerm::kMaxVariables> points;
    for (size_t i = 0; i < linearization_.size(); ++i) {
      points[i] = linearization_[i] != nullptr ? linearization_[i] : parameters[i];
    }
    if (!cost_->Evaluate(points.data(), residuals, jacobians)) return false;
  }
  return cost_->Evaluate(parameters, residuals, nullptr);
}

}  // namespace plm_vins

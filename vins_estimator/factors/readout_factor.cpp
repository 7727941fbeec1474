// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/readout_factor.h"

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace plm_vins {

ReadoutFactor::ReadoutFactor(std::unique_ptr<ceres::CostFunction> factor, size_t td_block,
                             const TimedBearing& bearing)
    : factor_(std::move(factor)), td_block_(td_block), bearing_(bearing) {
  set_num_residuals(factor_->num_residuals());
  *mutable_parameter_block_sizes() = factor_->parameter_block_sizes();
  mutable_parameter_block_sizes()->push_back(1);
}

bool ReadoutFactor::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const size_t readout_block = parameter_block_sizes().size() - 1;
  const double td = parameters[td_block_][0] + bearing_.Delay(parameters[readout_block][0]);
  std::vector<const double*> delayed(parameters, parameters + readout_block);
  delayed[td_block_] = &td;
  if (jacobians == nullptr || jacobians[readout_block] == nullptr) {
    return factor_->Evaluate(delayed.data(), residuals, jacobians);
  }
  std::vector<double*> factor_jacobians(jacobians, jacobians + readout_block);
  Eigen::VectorXd d_residual_d_td(num_residuals());
  if (factor_jacobians[td_block_] == nullptr) factor_jacobians[td_block_] = d_residual_d_td.data();
  if (!factor_->Evaluate(delayed.data(), residuals, factor_jacobians.data())) return false;
  for (int i = 0; i < num_residuals(); ++i) {
    jacobians[readout_block][i] = bearing_.share * factor_jacobians[td_block_][i];
  }
  return true;
}

}  // namespace plm_vins

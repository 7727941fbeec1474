// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/readout_factor.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "vins_estimator/factors/point_factor.h"

namespace plm_vins {

template <typename Inner>
ReadoutFactor<Inner>::ReadoutFactor(const Inner& factor, const TimedBearing& bearing)
    : Factor(factor.num_residuals()), factor_(factor), bearing_(bearing) {}

template <typename Inner>
bool ReadoutFactor<Inner>::Evaluate(double const* const* parameters, double* residuals,
                                    double** jacobians) const {
  constexpr int kTd = Inner::kTdBlock, kReadout = Inner::kBlocks;
  const double td = parameters[kTd][0] + bearing_.Delay(parameters[kReadout][0]);
  std::array<const double*, Inner::kBlocks> delayed;
  std::copy_n(parameters, delayed.size(), delayed.begin());
  delayed[kTd] = &td;
  if (jacobians == nullptr || jacobians[kReadout] == nullptr) {
    return factor_.Evaluate(delayed.data(), residuals, jacobians);
  }
  std::array<double*, Inner::kBlocks> factor_jacobians;
  std::copy_n(jacobians, factor_jacobians.size(), factor_jacobians.begin());
  Eigen::Vector2d d_residual_d_td;
  if (factor_jacobians[kTd] == nullptr) factor_jacobians[kTd] = d_residual_d_td.data();
  if (!factor_.Evaluate(delayed.data(), residuals, factor_jacobians.data())) return false;
  Eigen::Map<Eigen::Vector2d>{jacobians[kReadout]} =
      bearing_.share * Eigen::Map<const Eigen::Vector2d>(factor_jacobians[kTd]);
  return true;
}

template class ReadoutFactor<PointFactor>;
template class ReadoutFactor<PointHostFactor>;

}  // namespace plm_vins

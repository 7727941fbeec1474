// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/baseline_evidence.h"

#include <cmath>

#include "vins_estimator/problem/initial_prior.h"

namespace plm_vins {
namespace {

constexpr int kLengthIndex = 2;           // in the tangent of a mounting
constexpr double kMinSignificance = 3.0;  // in standard deviations
// Least relative error to report: the scale of an accelerometer is off by up to a percent.
constexpr double kMinError = 0.015;

}  // namespace

std::optional<double> BaselineError(const SlidingWindow& window, double configured_length,
                                    NormalEquations* equations) {
  const Eigen::MatrixXd covariance = equations->Covariance({{BlockKind::kMounting, 0}});
  if (covariance.size() == 0) return std::nullopt;
  const double x = std::log(window.T_C_C1().translation.norm() / configured_length);
  const double information = 1 / covariance(kLengthIndex, kLengthIndex);
  const double of_data = information - 1 / (kBaselineDeviation * kBaselineDeviation);
  if (!(of_data > 0)) return std::nullopt;
  const double error = x * information / of_data;
  const bool significant = std::abs(error) * std::sqrt(of_data) > kMinSignificance;
  if (!significant || std::abs(error) < kMinError) return std::nullopt;
  return error;
}

}  // namespace plm_vins

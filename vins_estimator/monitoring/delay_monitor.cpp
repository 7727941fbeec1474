// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/delay_monitor.h"

#include <cmath>

#include "common/forgetting_sum.h"

namespace plm_vins {
namespace {

constexpr double kDelayForgetting = 0.01;  // per image: 5 s at 20 Hz
constexpr double kMinCorrelation = 0.5;    // random correlation of 100 images is below 0.2
constexpr double kMinTimeOffset = 0.003;   // [s]; the optimization adapts to most of 10 ms
constexpr double kMinChange = 0.01;        // [rad^2/s^2], sum: unobservable without rotation

}  // namespace

void DelayMonitor::Add(const Eigen::Vector3d& rotation_residual,
                       const Eigen::Vector3d& rate_change) {
  AddForgetting(kDelayForgetting, rate_change.dot(rotation_residual), &change_residual_);
  AddForgetting(kDelayForgetting, rate_change.squaredNorm(), &change_change_);
  AddForgetting(kDelayForgetting, rotation_residual.squaredNorm(), &residual_residual_);
}

std::optional<double> DelayMonitor::delay() const {
  if (change_change_ < kMinChange || residual_residual_ == 0) return std::nullopt;
  const double correlation = change_residual_ / std::sqrt(change_change_ * residual_residual_);
  const double delay = change_residual_ / change_change_;
  const bool shows = std::abs(correlation) > kMinCorrelation && std::abs(delay) > kMinTimeOffset;
  return shows ? std::optional(delay) : std::nullopt;
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/stereo_monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/measurements.h"
#include "common/median.h"
#include "vins_estimator/monitoring/forgetting_sum.h"

namespace plm_vins {
namespace {

constexpr size_t kMinResiduals = 20;   // fewer are not representative
constexpr double kTimeConstant = 1.0;  // [s]
// Median length of a vector of two independent normal components, in standard deviations.
constexpr double kMedianLength = 1.1774;
constexpr double kMaxRatio = 4.0;       // of a usable camera's noise to that of the first
constexpr double kUnusableRatio = 1e3;  // takes the weight from the observations
constexpr double kMaxErrorRatio = 5.0;  // of an inlier to the noise
constexpr double kMinFlow = 10.0;       // root of the sum of squared flows for a delay [1/s]
constexpr double kMinDelay = 0.003;     // [s]

}  // namespace

DepthCounts StereoMonitor::Judge(const SlidingWindow& window, PointMap* points) {
  const std::vector<RightResidual> residuals = points->RightResiduals(window);
  Add(window.newest().state.t_ns, residuals);
  DepthCounts counts;
  for (const RightResidual& residual : residuals) {
    const bool wrong = residual.error.norm() > max_error();
    if (wrong) residual.view->right.reset();
    ++(wrong ? counts.rejected : counts.used);
  }
  return counts;
}

void StereoMonitor::Add(int64_t t_ns, const std::vector<RightResidual>& residuals) {
  if (residuals.size() < kMinResiduals) return;
  std::vector<double> lengths;
  lengths.reserve(residuals.size());
  for (const RightResidual& residual : residuals) lengths.push_back(residual.error.norm());
  const double noise = std::max(least_noise_, Median(std::move(lengths)) / kMedianLength);
  const double dt = newest_ns_ ? ToSeconds(t_ns - *newest_ns_) : kTimeConstant;
  const double share = newest_ns_ ? 1 - std::exp(-dt / kTimeConstant) : 1;
  newest_ns_ = t_ns;
  noise_ += share * (noise - noise_);
  double by_residual = 0, squared = 0;
  for (const RightResidual& residual : residuals) {
    const Eigen::Vector2d& flow = residual.view->bearing.velocity;
    if (residual.error.norm() > kMaxErrorRatio * noise_) continue;
    by_residual += flow.dot(residual.error);
    squared += flow.squaredNorm();
  }
  AddForgetting(share, by_residual, &flow_by_residual_);
  AddForgetting(share, squared, &flow_squared_);
}

double StereoMonitor::noise() const { return misfit() ? kUnusableRatio * least_noise_ : noise_; }

double StereoMonitor::max_error() const { return kMaxErrorRatio * noise_; }

std::optional<double> StereoMonitor::misfit() const {
  if (noise_ <= kMaxRatio * least_noise_) return std::nullopt;
  return kMedianLength * noise_;
}

std::optional<double> StereoMonitor::delay() const {
  if (!(flow_squared_ > kMinFlow * kMinFlow)) return std::nullopt;
  const double delay = -flow_by_residual_ / flow_squared_;
  if (std::abs(delay) < kMinDelay) return std::nullopt;
  return delay;
}

}  // namespace plm_vins

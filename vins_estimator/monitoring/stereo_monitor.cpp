// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/stereo_monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/forgetting_sum.h"
#include "common/measurements.h"
#include "common/median.h"

namespace plm_vins {
namespace {

constexpr size_t kMinResiduals = 20;   // fewer are not representative
constexpr double kTimeConstant = 1.0;  // [s]
// Median length of a vector of two independent normal components, in standard deviations.
constexpr double kMedianLength = 1.1774;
constexpr double kMaxRatio = 4.0;       // largest noise of a usable camera over that of the first
constexpr double kUnusableRatio = 1e3;  // makes the weight of the observations negligible
constexpr double kMaxUnjudged = 1.5;    // longest time without point residuals to use lines [s]
constexpr double kMaxErrorRatio = 5.0;  // error of an inlier, in units of the noise
constexpr size_t kMinLineResiduals = 8;
constexpr double kMinFlow = 10.0;    // root of the sum of squared flows for a delay [1/s]
constexpr double kMinDelay = 0.003;  // [s]

// Returns the weight of the newest value in a mean over the time constant.
double ShareOfNewest(int64_t t_ns, std::optional<int64_t>* before_ns) {
  const double dt = *before_ns ? ToSeconds(t_ns - **before_ns) : kTimeConstant;
  const double share = *before_ns ? 1 - std::exp(-dt / kTimeConstant) : 1;
  *before_ns = t_ns;
  return share;
}

}  // namespace

DepthCounts StereoMonitor::Judge(const SlidingWindow& window, PointMap* points, LineMap* lines) {
  const std::vector<RightResidual> residuals = points->RightResiduals(window);
  Add(window.newest().state.t_ns, residuals);
  DepthCounts counts;
  for (const RightResidual& residual : residuals) {
    const bool wrong = residual.error.norm() > max_error();
    if (wrong) residual.view->right.reset();
    ++(wrong ? counts.rejected : counts.used);
  }
  const std::vector<RightLineResidual> of_lines = lines->RightResiduals(window);
  Add(window.newest().state.t_ns, of_lines);
  for (const RightLineResidual& residual : of_lines) {
    if (residual.error > kMaxErrorRatio * M_SQRT2 * line_noise_factor_)
      residual.view->right.reset();
  }
  return counts;
}

void StereoMonitor::Add(int64_t t_ns, const std::vector<RightResidual>& residuals) {
  if (residuals.size() < kMinResiduals) return;
  std::vector<double> lengths;
  lengths.reserve(residuals.size());
  for (const RightResidual& residual : residuals) lengths.push_back(residual.error.norm());
  const double noise = std::max(least_noise_, Median(std::move(lengths)) / kMedianLength);
  const double share = ShareOfNewest(t_ns, &newest_ns_);
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

void StereoMonitor::Add(int64_t t_ns, const std::vector<RightLineResidual>& residuals) {
  if (residuals.size() < kMinLineResiduals) return;
  std::vector<double> errors;
  errors.reserve(residuals.size());
  for (const RightLineResidual& residual : residuals) errors.push_back(residual.error);
  const double factor = std::max(1.0, Median(std::move(errors)) / kMedianLength);
  line_noise_factor_ += ShareOfNewest(t_ns, &newest_line_ns_) * (factor - line_noise_factor_);
}

bool StereoMonitor::UsesLines(int64_t t_ns) const {
  const bool is_judged = newest_ns_ && ToSeconds(t_ns - *newest_ns_) < kMaxUnjudged;
  return is_judged && !misfit() && line_noise_factor_ < kMaxRatio;
}

double StereoMonitor::line_noise_factor(int64_t t_ns) const {
  return UsesLines(t_ns) ? line_noise_factor_ : kUnusableRatio;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/camera_monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/measurements.h"
#include "common/statistics.h"

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

double SizeOf(const PointResidual& residual) { return residual.error.norm(); }
double SizeOf(const LineResidual& residual) { return residual.error; }

// Returns the median size of the residuals in units of their standard deviation, if these are
// normal; nullopt for too few.
template <typename Residual>
std::optional<double> MedianDeviation(const std::vector<Residual>& residuals, size_t min_count) {
  std::vector<double> sizes;
  sizes.reserve(residuals.size());
  for (const Residual& residual : residuals) {
    if (std::isfinite(SizeOf(residual))) sizes.push_back(SizeOf(residual));
  }
  if (sizes.size() < min_count) return std::nullopt;
  return Median(std::move(sizes)) / kMedianLength;
}

// Removes the observations with a larger residual, unless the camera hosts the landmark.
template <typename Residual, typename Map>
DepthCounts RemoveOutliers(const std::vector<Residual>& residuals, double max_size, Map* map) {
  DepthCounts counts;
  for (const Residual& residual : residuals) {
    if (residual.is_in_host_camera) continue;
    const bool wrong = SizeOf(residual) > max_size;
    if (wrong) map->Remove(residual.id, residual.image);
    ++(wrong ? counts.rejected : counts.used);
  }
  return counts;
}

}  // namespace

DepthCounts CameraMonitor::Judge(const SlidingWindow& window, PointMap* points, LineMap* lines) {
  const int64_t t_ns = window.newest().state.t_ns;
  const std::vector<PointResidual> of_points = points->ResidualsIn(camera_, window);
  const std::vector<LineResidual> of_lines = lines->ResidualsIn(camera_, least_.line, window);
  Add(t_ns, of_points);
  Add(t_ns, of_lines);
  RemoveOutliers(of_lines, kMaxErrorRatio * M_SQRT2 * line_noise_factor_, lines);
  return RemoveOutliers(of_points, kMaxErrorRatio * noise_, points);
}

void CameraMonitor::Add(int64_t t_ns, const std::vector<PointResidual>& residuals) {
  const auto deviation = MedianDeviation(residuals, kMinResiduals);
  if (!deviation) return;
  const double share = ShareOfNewest(t_ns, &newest_ns_);
  noise_ += share * (std::max(least_.point, *deviation) - noise_);
  double by_residual = 0, squared = 0;
  for (const PointResidual& residual : residuals) {
    if (!(residual.error.norm() <= kMaxErrorRatio * noise_)) continue;
    by_residual += residual.flow.dot(residual.error);
    squared += residual.flow.squaredNorm();
  }
  AddForgetting(share, by_residual, &flow_by_residual_);
  AddForgetting(share, squared, &flow_squared_);
}

void CameraMonitor::Add(int64_t t_ns, const std::vector<LineResidual>& residuals) {
  const auto deviation = MedianDeviation(residuals, kMinLineResiduals);
  if (!deviation) return;
  line_noise_factor_ +=
      ShareOfNewest(t_ns, &newest_line_ns_) * (std::max(1.0, *deviation) - line_noise_factor_);
}

bool CameraMonitor::UsesLines(int64_t t_ns) const {
  const bool is_judged = newest_ns_ && ToSeconds(t_ns - *newest_ns_) < kMaxUnjudged;
  return is_judged && !misfit() && line_noise_factor_ < kMaxRatio;
}

double CameraMonitor::line_noise_factor(int64_t t_ns) const {
  return UsesLines(t_ns) ? line_noise_factor_ : kUnusableRatio;
}

double CameraMonitor::noise() const { return misfit() ? kUnusableRatio * least_.point : noise_; }

std::optional<double> CameraMonitor::misfit() const {
  if (noise_ <= kMaxRatio * least_.point) return std::nullopt;
  return kMedianLength * noise_;
}

std::optional<double> CameraMonitor::delay() const {
  if (!(flow_squared_ > kMinFlow * kMinFlow)) return std::nullopt;
  const double delay = -flow_by_residual_ / flow_squared_;
  if (std::abs(delay) < kMinDelay) return std::nullopt;
  return delay;
}

}  // namespace plm_vins

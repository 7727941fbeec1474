// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/feature_noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/measurements.h"
#include "common/median.h"

namespace plm_vins {
namespace {

constexpr size_t kMinLandmarks = 24;    // least sample size
constexpr double kGreatestRatio = 9.0;  // ratio of variances, to the median landmark's
constexpr double kGreatestCorrelation = 0.8;
constexpr double kTimeConstant = 2.5;  // [s]
constexpr double kMinMotion = 0.3;     // between the first and the last frame of the window [m]
constexpr double kLeast = 0.5, kMost = 4.0;  // bounds, times the configured noise

template <typename Landmarks>
std::vector<ResidualSpread> CollectSpreads(const Landmarks& landmarks,
                                           const SlidingWindow& window) {
  std::vector<ResidualSpread> spreads;
  for (const auto& [id, landmark] : landmarks) {
    if (const auto spread = SpreadOf(landmark, window)) spreads.push_back(*spread);
  }
  return spreads;
}

double MedianVariance(const std::vector<ResidualSpread>& spreads) {
  std::vector<double> variances;
  variances.reserve(spreads.size());
  for (const ResidualSpread& spread : spreads) variances.push_back(spread.variance);
  return Median(std::move(variances));
}

// Moves `noise` toward the observed value, in logarithmic scale.
void Follow(std::optional<double> seen, double first, double share, double* noise) {
  if (!seen) return;
  const double goal = std::clamp(*seen, kLeast * first, kMost * first);
  *noise *= std::pow(goal / *noise, share);
}

double MotionOver(const SlidingWindow& window) {
  return (window.newest().state.position() - window.frames.front().state.position()).norm();
}

}  // namespace

std::optional<double> EffectiveNoise(const std::vector<ResidualSpread>& spreads) {
  if (spreads.size() < kMinLandmarks) return std::nullopt;
  const double limit = kGreatestRatio * MedianVariance(spreads);
  double variance = 0, difference = 0;
  for (const ResidualSpread& spread : spreads) {
    const double share = spread.variance > limit ? limit / spread.variance : 1.0;
    variance += share * spread.variance;
    difference += share * spread.difference;
  }
  if (!(variance > 0) || !std::isfinite(variance)) return std::nullopt;
  const double correlation = std::clamp(1 - difference / variance, 0.0, kGreatestCorrelation);
  variance /= static_cast<double>(spreads.size());
  return std::sqrt(variance * (1 + correlation) / (1 - correlation));
}

void FeatureNoise::Update(const LocalMap& map) {
  const SlidingWindow& window = map.window;
  const int64_t newest_ns = window.newest().state.t_ns;
  const double dt = newest_ns_ ? ToSeconds(newest_ns - *newest_ns_) : 0;
  newest_ns_ = newest_ns;
  if (window.newest().stationary || MotionOver(window) < kMinMotion) return;
  const double share = 1 - std::exp(-dt / kTimeConstant);
  const auto points = CollectSpreads(map.points.landmarks(), window);
  const auto lines = CollectSpreads(map.lines.landmarks(), window);
  Follow(EffectiveNoise(points), first_point_, share, &point_);
  Follow(EffectiveNoise(lines), first_line_, share, &line_);
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/feature_noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/measurements.h"
#include "common/statistics.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"

namespace plm_vins {
namespace {

constexpr size_t kMinViews = 6;
constexpr int kPointParameters = 3, kLineParameters = 4;
constexpr double kGreatestLength = 3.0;  // length of a residual, relative to the median one

// Clips outlier residuals, which may belong to another scene point.
void ShortenOutliers(std::vector<Eigen::Vector2d>* residuals) {
  std::vector<double> lengths;
  lengths.reserve(residuals->size());
  for (const Eigen::Vector2d& residual : *residuals) lengths.push_back(residual.norm());
  const double limit = kGreatestLength * Median(std::move(lengths));
  for (Eigen::Vector2d& residual : *residuals) {
    const double length = residual.norm();
    if (length > limit) residual *= limit / length;
  }
}

// Returns the residuals in the host's camera by time.
std::vector<Eigen::Vector2d> ResidualsOf(const PointLandmark& point, const SlidingWindow& window) {
  const Eigen::Vector3d p_W = PositionInWorld(point, window);
  std::vector<Eigen::Vector2d> residuals;
  residuals.reserve(point.observations.size());
  for (const PointLandmark::Observation& observation : point.observations) {
    if (observation.camera != point.host().camera) continue;
    const Eigen::Vector3d p_C = window.T_W_C(observation).Inverse() * p_W;
    residuals.push_back(p_C.hnormalized() - window.AtState(observation.bearing));
  }
  return residuals;
}

std::vector<Eigen::Vector2d> ResidualsOf(const LineLandmark& line, const SlidingWindow& window) {
  const PluckerLine line_W = LineInWorld(line, window);
  std::vector<Eigen::Vector2d> residuals;
  residuals.reserve(line.observations.size());
  for (const LineLandmark::Observation& observation : line.observations) {
    if (observation.camera != line.host().camera) continue;
    if (const auto distances = DistancesOf(observation, line_W, window)) {
      residuals.push_back(*distances);
    }
  }
  return residuals;
}

template <typename Landmark>
std::optional<ResidualSpread> SpreadOfViews(const Landmark& landmark, const SlidingWindow& window,
                                            int parameters) {
  if (!landmark.triangulated || landmark.observations.size() < kMinViews) return std::nullopt;
  std::vector<Eigen::Vector2d> residuals = ResidualsOf(landmark, window);
  if (residuals.size() < kMinViews) return std::nullopt;
  return SpreadOf(std::move(residuals), parameters);
}

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

ResidualSpread SpreadOf(std::vector<Eigen::Vector2d> residuals, int parameters) {
  ShortenOutliers(&residuals);
  const double count = static_cast<double>(residuals.size());
  ResidualSpread spread;
  for (size_t i = 0; i < residuals.size(); ++i) {
    spread.variance += residuals[i].squaredNorm() / (2 * count - parameters);
    if (i == 0) continue;
    spread.difference += (residuals[i] - residuals[i - 1]).squaredNorm() / (4 * (count - 1));
  }
  return spread;
}

std::optional<ResidualSpread> SpreadOf(const PointLandmark& point, const SlidingWindow& window) {
  return SpreadOfViews(point, window, kPointParameters);
}

std::optional<ResidualSpread> SpreadOf(const LineLandmark& line, const SlidingWindow& window) {
  return SpreadOfViews(line, window, kLineParameters);
}

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

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/residual_spread.h"

#include <utility>

#include "common/median.h"
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

}  // namespace plm_vins

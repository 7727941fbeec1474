// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/map/point_landmark.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Residual statistics of one landmark after optimization, corrected for the degrees of freedom of
// its own parameters.
struct ResidualSpread {
  double variance = 0;    // variance of one residual coordinate
  double difference = 0;  // half the variance of the step between consecutive residuals
};

// Computes the statistics of at least two residuals, by time, of a landmark with `parameters`
// degrees of freedom. Outlier residuals are clipped to three times the median length.
ResidualSpread SpreadOf(std::vector<Eigen::Vector2d> residuals, int parameters);

// Returns the statistics of a triangulated landmark in the window, normalized: of a point in x and
// y, of a line at the start and end of the segment, across the line. Returns nullopt for fewer than
// six observations, from which the correlation cannot be estimated.
std::optional<ResidualSpread> SpreadOf(const PointLandmark& point, const SlidingWindow& window);
std::optional<ResidualSpread> SpreadOf(const LineLandmark& line, const SlidingWindow& window);

// Returns the standard deviation at which independent observations would carry as much information
// as the given ones; nullopt for too few landmarks. Errors along a track are correlated: a template
// drifts, an outline shifts with the viewpoint. With the correlation of consecutive errors, rho = 1
// - difference / variance, n observations are worth n (1 - rho) / (1 + rho) independent ones
// (first-order autoregression, [Bayley1946]). Outlier landmarks are clipped to three times the
// median standard deviation.
std::optional<double> EffectiveNoise(const std::vector<ResidualSpread>& spreads);

// Estimates the noise of corners and line end points from the residuals of the optimized window,
// because texture, blur, compression and calibration make it differ between cameras. Adapts slowly
// and within bounds, so that no single window determines its own weight.
class FeatureNoise {
 public:
  // Takes the configured noise, normalized.
  FeatureNoise(double point_noise, double line_noise)
      : first_point_(point_noise),
        first_line_(line_noise),
        point_(first_point_),
        line_(first_line_) {}

  // Updates the estimate from a window that was just optimized. Ignores windows with little motion,
  // in which errors are the same in all observations.
  void Update(const LocalMap& map);

  double point() const { return point_; }
  double line() const { return line_; }

 private:
  double first_point_, first_line_;
  double point_, line_;
  std::optional<int64_t> newest_ns_;  // newest image of the last window
};

}  // namespace plm_vins

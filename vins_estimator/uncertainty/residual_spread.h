// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vins_estimator/map/line_landmark.h"
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

}  // namespace plm_vins

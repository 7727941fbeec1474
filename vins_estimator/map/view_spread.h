// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/point_landmark.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// How far the views of one landmark are from it, once it is estimated: without the share that its
// own parameters took up.
struct ViewSpread {
  double variance = 0;    // of one coordinate of the residuals
  double difference = 0;  // half the variance of the step from one view to the next
};

// `residuals` by time, at least two, of a landmark with so many parameters.
// Single views far off count as three times the median one.
ViewSpread SpreadOf(std::vector<Eigen::Vector2d> residuals, int parameters);

// Of a triangulated landmark's views in the window, normalised: of a point in x and y, of a line at
// the start and the end of the segment, across the line. Nothing for fewer than six views, which
// hardly show how their errors follow on each other.
std::optional<ViewSpread> SpreadOf(const PointLandmark& point, const SlidingWindow& window);
std::optional<ViewSpread> SpreadOf(const LineLandmark& line, const SlidingWindow& window);

}  // namespace plm_vins

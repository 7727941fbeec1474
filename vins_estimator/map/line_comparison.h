// SPDX-License-Identifier: BSD-3-Clause
// Whether two lines of the map are one, for merging and recognition.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <optional>

#include "common/config/estimator_config.h"
#include "vins_estimator/geometry/line_pairs.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Limits within which two lines are taken for one.
struct SameLineLimits {
  // `focal_length` [px] turns pixels into normalised coordinates.
  SameLineLimits(const EstimatorConfig& config, double focal_length)
      : distance(config.line_merge_distance),
        image_distance(config.line_merge_image_distance / focal_length),
        angle(config.line_merge_angle * M_PI / 180),
        noise(config.line_noise / focal_length) {}

  double distance;        // between the lines in space, and between their ends [m]
  double image_distance;  // between line and segment in an image, normalised
  double angle;           // between the directions [rad]
  double noise;           // deviation of an end point across the line, normalised
};

// The condition in space that two lines fail; kNone where they meet all. Where direction or place
// are known less well than the limits, kLineDeviations times their deviations take their place.
enum class LineDifference { kNone, kDirection, kDistance, kGap };
LineDifference FindDifference(const SameLineLimits& limits, const LinePairGeometry& pair);

// Enough views to estimate how well a line is known.
inline bool HasEnoughViews(const LineLandmark& line) { return line.views.size() >= 3; }

// The seen part of a triangulated line in a frame F, and how well its views determine its place,
// where there are enough. Nothing where it has no image in a camera that saw it.
std::optional<SeenLine> See(const SlidingWindow& window, const Eigen::Quaterniond& R_F_W,
                            double noise, const LineLandmark& line);

// How far the ends of a seen segment are from the image of a line, at most; normalised. Infinite
// where the line has no image.
double DistanceInImage(const SlidingWindow& window, const PluckerLine& line_W,
                       const LineView& view);

}  // namespace plm_vins

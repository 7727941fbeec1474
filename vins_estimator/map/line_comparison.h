// SPDX-License-Identifier: BSD-3-Clause
// Tests of whether two line landmarks are the same line, for merging and recognition.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <optional>

#include "common/config/estimator_config.h"
#include "vins_estimator/geometry/line_pairs.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/map/landmark_map.h"
#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Limits within which two lines count as the same line.
struct SameLineLimits {
  // `focal_length` [px] converts pixels to normalized coordinates.
  SameLineLimits(const EstimatorConfig& config, double focal_length)
      : distance(config.line_merge_distance),
        image_distance(config.line_merge_image_distance / focal_length),
        noise(config.line_noise / focal_length) {}

  double distance;                // between the lines in space, and between their ends [m]
  double image_distance;          // between line and segment in an image, normalized
  double angle = 3 * M_PI / 180;  // between the directions [rad]
  double noise;                   // standard deviation of an end point across the line, normalized
};

// Returns the first condition in space that two lines violate; kNone if they meet all. Where
// direction or position are less certain than the limits, kLineDeviations times their standard
// deviations are the limits.
enum class LineDifference { kNone, kDirection, kDistance, kGap };
LineDifference FindDifference(const SameLineLimits& limits, const LinePairGeometry& pair);

// Returns whether the observations suffice to estimate the line's covariance.
inline bool HasEnoughObservations(const LineLandmark& line) {
  return OfHostCamera(line).size() >= 3;
}

// Returns the observed segment of a triangulated line in a frame F, with its standard deviations,
// which are zero if there are too few observations to estimate them. Returns nullopt if the line
// has no projection in a camera that observed it.
std::optional<SeenLine> See(const SlidingWindow& window, const Eigen::Quaterniond& R_F_W,
                            double noise, const LineLandmark& line);

// Returns the greater distance of a segment's end points from the projection of a line, normalized.
// Infinite if the line has no projection.
double DistanceInImage(const SlidingWindow& window, const PluckerLine& line_W,
                       const LineLandmark::Observation& observation);

}  // namespace plm_vins

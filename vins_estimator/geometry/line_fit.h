// SPDX-License-Identifier: BSD-3-Clause
// The least-squares problem of one line seen by several cameras whose poses are known.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/geometry/rigid3.h"
#include "vins_estimator/geometry/line_segment_view.h"
#include "vins_estimator/geometry/plucker.h"

namespace plm_vins {

// A camera that sees a segment of a line.
struct LineSighting {
  Rigid3d T_W_C;
  LineSegmentView segment;
};

// A line in the frame of the first camera that sees it, and how well it fits.
struct LineFit {
  OrthonormalLine line = {0, 0, 0, 1, 0};
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();  // of the line's tangent
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();     // of cost / 2, by the tangent
  double cost = 0;  // sum of the squared distances of all end points, in units of the noise
};

// How well `line` fits, as it is. `noise`: deviation of an end point across the line, normalised.
// Nothing where the line passes through a camera.
std::optional<LineFit> EvaluateLine(const std::vector<LineSighting>& sightings, double noise,
                                    const OrthonormalLine& line);

// The line near `initial` that fits best ([Bartoli2005], section 5).
std::optional<LineFit> FitLine(const std::vector<LineSighting>& sightings, double noise,
                               const OrthonormalLine& initial);

// Standard deviation of the line's direction where it is known least [rad]; 1 at most.
double DirectionDeviation(const LineFit& fit);

// Standard deviation of the line's place across itself, near its point `p_C0`, where it is known
// least [m].
double PlaceDeviation(const LineFit& fit, const Eigen::Vector3d& p_C0);

}  // namespace plm_vins

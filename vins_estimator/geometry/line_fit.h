// SPDX-License-Identifier: BSD-3-Clause
// Least-squares fit of a line to its observations in several cameras with known poses.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/geometry/rigid3.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/geometry/segment_end_points.h"

namespace plm_vins {

// Observation of a line segment by a camera with known pose.
struct PosedLineObservation {
  Rigid3d T_W_C;
  SegmentEndPoints segment;
};

// A line in the frame of the first observing camera, with its normal equations.
struct LineFit {
  OrthonormalLine line = {0, 0, 0, 1, 0};
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();  // in the line's tangent
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();     // gradient of cost / 2, in the tangent
  double cost = 0;  // sum of squared end point distances, in units of the noise
};

// Evaluates cost, gradient and information of `line` without changing it. `noise` is the standard
// deviation of an end point across the line, in normalized coordinates. Returns nullopt if the line
// passes through a camera.
std::optional<LineFit> EvaluateLine(const std::vector<PosedLineObservation>& observations,
                                    double noise, const OrthonormalLine& line);

// Returns the least-squares line near `initial` ([Bartoli2005], section 5); nullopt if it
// degenerates.
std::optional<LineFit> FitLine(const std::vector<PosedLineObservation>& observations, double noise,
                               const OrthonormalLine& initial);

// Returns the standard deviation of the line's direction along its least certain axis [rad], at
// most 1.
double DirectionDeviation(const LineFit& fit);

// Returns the standard deviation of the line's position perpendicular to itself, near its point
// `p_C0`, along the least certain axis [m].
double PlaceDeviation(const LineFit& fit, const Eigen::Vector3d& p_C0);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
// Search for pairs of line landmarks that are close in space, and their relative geometry.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// The observed segment of a line in a frame F; `axis` is an axis of F.
struct SeenLine {
  Eigen::Vector3d start_F = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d end_F = Eigen::Vector3d::Zero();    // [m]
  LineAxis axis = LineAxis::kFree;
  double direction_sigma = 0;  // standard deviation of the direction [rad]
  double place_sigma = 0;      // standard deviation of the position across the line [m]

  Eigen::Vector3d Direction() const { return (end_F - start_F).normalized(); }
};

// Greatest distance between observations of one line, in standard deviations. FindNearPairs and
// FindDifference share it: the search radius is at least the acceptance threshold.
constexpr double kLineDeviations = 3.0;

// Returns index pairs (greater, smaller), sorted, of the lines whose bounding boxes along the axes
// of F are less than `distance` [m] apart, allowing for their standard deviations. Sweeps along z;
// its cost grows with the number of pairs that overlap in z. In the Manhattan frame the box of a
// line along an axis is thin, so boxes hardly touch unless the lines do.
std::vector<std::pair<size_t, size_t>> FindNearPairs(const std::vector<SeenLine>& lines,
                                                     double distance);

// Relative position of two lines.
struct LinePairGeometry {
  double angle = 0;           // between the directions, regardless of sign [rad]
  double distance = 0;        // perpendicular to the common direction, between the midpoints [m]
  double gap = 0;             // along the common direction, between the ends; negative: overlap [m]
  double angle_sigma = 0;     // standard deviation of the angle [rad]
  double distance_sigma = 0;  // standard deviation of the distance [m]
};

// Compares two lines along their common direction: their axis if it is the same, otherwise the mean
// of their directions.
LinePairGeometry Compare(const SeenLine& a, const SeenLine& b);

}  // namespace plm_vins

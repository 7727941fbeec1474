// SPDX-License-Identifier: BSD-3-Clause
// Pairs of line landmarks that are near each other in space, and how near.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "vins_estimator/state/line_axis.h"

namespace plm_vins {

// The seen part of a line in some frame F; the axis is one of F.
struct SeenLine {
  Eigen::Vector3d start_F = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d end_F = Eigen::Vector3d::Zero();    // [m]
  LineAxis axis = LineAxis::kFree;
  double direction_sigma = 0;  // standard deviation of the direction [rad]
  double place_sigma = 0;      // and of the place across it [m]

  Eigen::Vector3d Direction() const { return (end_F - start_F).normalized(); }
};

// How far lines that are one may be apart, in standard deviations. Who looks for pairs allows no
// less than who judges them (FindDifference), so that none is missed.
constexpr double kLineDeviations = 3.0;

// Indices (greater, smaller) of the lines whose boxes along the axes of F are less than `distance`
// [m] apart, allowing for their deviations; sorted. A sweep along z: time grows with the number of
// pairs that overlap in z. In the Manhattan frame the box of a line along an axis is a needle, so
// that hardly any two boxes touch unless the lines do.
std::vector<std::pair<size_t, size_t>> FindNearPairs(const std::vector<SeenLine>& lines,
                                                     double distance);

// The position of two lines relative to each other.
struct LinePairGeometry {
  double angle = 0;        // between the directions, whichever way they point [rad]
  double distance = 0;     // beside each other, from middle to middle [m]
  double gap = 0;          // between the ends, along their common direction; negative: overlap [m]
  double angle_sigma = 0;  // standard deviations [rad], [m]
  double distance_sigma = 0;
};

// The common direction is the axis of both, else the mean of their directions.
LinePairGeometry Compare(const SeenLine& a, const SeenLine& b);

}  // namespace plm_vins

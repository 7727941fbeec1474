// SPDX-License-Identifier: BSD-3-Clause
// Exchange between the line landmarks and the Manhattan frame: line directions in one direction,
// axis labels in the other.
#pragma once

#include <vector>

#include "vins_estimator/manhattan/manhattan_frame.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Returns the directions of all triangulated lines, with standard deviations from the observations
// in the window. `noise` is the standard deviation of an end point across its line, in normalized
// coordinates.
std::vector<LineDirection> LineDirections(const SlidingWindow& window, const LineMap& lines,
                                          double noise);

// Labels each line whose direction is accurate enough with its Manhattan axis. Other lines keep
// their label: a line stays parallel to its axis even when the observations that proved it have
// left the window.
void NameAxes(const ManhattanFrame& frame, const std::vector<LineDirection>& directions,
              LineMap* lines);

}  // namespace plm_vins

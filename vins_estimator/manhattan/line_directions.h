// SPDX-License-Identifier: BSD-3-Clause
// What passes between the line landmarks and the Manhattan frame: their directions one way, the
// names of their axes the other.
#pragma once

#include <vector>

#include "vins_estimator/manhattan/manhattan_frame.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Directions of the triangulated lines, with the standard deviation that the views in the window
// leave them, for end points with a deviation of `noise` (normalised) across the line.
std::vector<LineDirection> LineDirections(const SlidingWindow& window, const LineMap& lines,
                                          double noise);

// Names the axis of the lines whose direction is known well. The others keep the name that they
// have: their older views may have left the window, but not the line its axis.
void NameAxes(const ManhattanFrame& frame, const std::vector<LineDirection>& directions,
              LineMap* lines);

}  // namespace plm_vins

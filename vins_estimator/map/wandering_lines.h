// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/map/view_spread.h"

namespace plm_vins {

// The views of a line of this noise (deviation across it, normalised) are off it by more than
// noise, and go from side to side slowly: neighbouring ones are off alike. That tells what wanders
// with the viewpoint or the light, as the outline of a round thing, a shadow or a reflection do,
// from a line that is seen badly: there, von Neumann's ratio of the mean square of steps to the
// variance is about 2 ([vonNeumann1941]).
bool Wanders(const ViewSpread& spread, double noise);

// Finds the triangulated lines that wander, each once. The window goes on using them, as far as
// they fit: leaving out lines by their residuals leaves out what contradicts the estimate. But they
// are neither merged nor remembered (MayLast). Returns how many were found.
int NoteWandering(const SlidingWindow& window, double noise, LineMap* lines);

}  // namespace plm_vins

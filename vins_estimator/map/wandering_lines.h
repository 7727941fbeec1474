// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/map/view_spread.h"

namespace plm_vins {

// Returns whether the residuals of a line's observations exceed the noise (standard deviation
// across it, normalized) and consecutive residuals are correlated. Such lines move with the
// viewpoint or the light: outlines of round objects, shadows, reflections. For a static line with
// noisy observations, von Neumann's ratio of the mean square of successive differences to the
// variance is about 2 ([vonNeumann1941]).
bool Wanders(const ViewSpread& spread, double noise);

// Marks the triangulated wandering lines, each once. The window still uses them as far as their
// residuals permit, since rejecting lines by residuals would reject what contradicts the estimate.
// They are neither merged nor remembered (MayLast). Returns the number of newly marked lines.
int NoteWandering(const SlidingWindow& window, double noise, LineMap* lines);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linefeature_tracker/detection/edge_chains.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

struct StraightnessLimits {
  int min_steps;            // from the first to the last pixel of a segment
  double max_deviation_px;  // of a pixel from the line
};

// Appends the straight segments of a chain [px], in its order [Lee2014]: one begins where
// `min_steps` pixels are straight, goes on while the next ones are near the line through those
// before, and ends at the feet of its first and last pixel on that line.
void AppendSegments(const EdgeChain& chain, const StraightnessLimits& limits,
                    std::vector<LineSegment>* segments);

}  // namespace plm_vins

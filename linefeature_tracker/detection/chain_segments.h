// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linefeature_tracker/detection/edge_chains.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

struct StraightnessLimits {
  int min_steps;            // between the first and last pixel of a segment
  double max_deviation_px;  // of a pixel from the line
};

// Appends the straight segments of a chain [px], in chain order [Lee2014]. A segment begins with
// `min_steps` collinear pixels, continues while the next pixels are close to the line fitted so
// far, and ends at the projections of its first and last pixel onto that line.
void AppendSegments(const EdgeChain& chain, const StraightnessLimits& limits,
                    std::vector<LineSegment>* segments);

}  // namespace plm_vins

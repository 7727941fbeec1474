// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

struct SegmentMergingLimits {
  double gap = 12;        // maximum distance between the endpoints to be joined
  double distance = 1.5;  // maximum distance of a fragment's endpoints from the other's line
  double angle = 0.07;    // maximum angle between the lines [rad]
};

// Joins collinear fragments of the same direction end to start, starting with the longest. Lengths
// are in the unit of the segments. The result is ordered by the longest fragment of each line.
//
// Endpoints are sorted into cells of the size of the gap, so that the time is linear in the number
// of segments. Bins of angle and offset would not work, since the offset of a short fragment far
// from the origin is more uncertain than any useful bin size.
std::vector<LineSegment> JoinFragments(const std::vector<LineSegment>& segments,
                                       const SegmentMergingLimits& limits);

}  // namespace plm_vins

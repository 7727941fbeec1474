// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

struct SegmentMergingLimits {
  double gap = 12;        // between the ends that are joined
  double distance = 1.5;  // of the ends of one from the line of the other
  double angle = 0.07;    // between the lines [rad]
};

// Joins collinear fragments of the same direction end to start, the longest first, as long as there
// is one to add. Lengths are in the unit of the segments. What is returned keeps the order of the
// longest fragments.
//
// Ends are sorted into cells of the size of the gap, so that the time grows with the number of
// segments and not with its square; bins of angle and offset would not do, as the offset of a short
// fragment far from the origin is uncertain by more than any useful bin.
std::vector<LineSegment> JoinFragments(const std::vector<LineSegment>& segments,
                                       const SegmentMergingLimits& limits);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Signed distance of a line from a segment, positive on the side of its Normal() (normalized).
struct LineOffset {
  double at_start = 0;
  double slope = 0;  // change along the segment

  // `along` is measured from the segment's start.
  double At(double along) const { return at_start + slope * along; }
};

// Returns the segment moved by the offset.
inline LineSegment Shifted(const LineSegment& segment, const LineOffset& offset) {
  const Eigen::Vector2d normal = segment.Normal();
  return {segment.start + offset.at_start * normal,
          segment.end + offset.At(segment.Length()) * normal};
}

}  // namespace plm_vins

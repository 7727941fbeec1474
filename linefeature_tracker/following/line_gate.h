// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Tests whether a line may be the predicted one by direction (with brighter side), distance and
// overlap. Segments are normalized.
class LineGate {
 public:
  // `focal_length` [px/rad].
  explicit LineGate(double focal_length) : max_distance_(kMaxDistance_px / focal_length) {}

  bool Accepts(const LineSegment& predicted, const LineSegment& found) const {
    if (DirectedAngle(predicted, found) > kMaxAngle) return false;
    const SegmentRelation relation = Relate(predicted, found);
    return relation.distance <= max_distance_ && relation.overlap >= kMinOverlap;
  }

 private:
  static constexpr double kMaxAngle = 10 * M_PI / 180;  // [rad]
  static constexpr double kMaxDistance_px = 40;
  static constexpr double kMinOverlap = 0.5;  // relative to the shorter line

  double max_distance_;
};

}  // namespace plm_vins

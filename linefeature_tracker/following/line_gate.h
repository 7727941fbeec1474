// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Tests whether a line may be the predicted one by direction (with brighter side), distance and
// overlap. Segments are normalized.
class LineGate {
 public:
  // `focal_length` [px/rad].
  LineGate(const LineTrackerConfig& config, double focal_length)
      : max_angle_(config.max_angle * M_PI / 180),
        max_distance_(config.max_distance / focal_length),
        min_overlap_(config.min_overlap) {}

  bool Accepts(const LineSegment& predicted, const LineSegment& found) const {
    if (DirectedAngle(predicted, found) > max_angle_) return false;
    const SegmentRelation relation = Relate(predicted, found);
    return relation.distance <= max_distance_ && relation.overlap >= min_overlap_;
  }

 private:
  double max_angle_;  // [rad]
  double max_distance_;
  double min_overlap_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Lines of an image, to detect duplicates.
class LineOccupancy {
 public:
  explicit LineOccupancy(double spacing_px) : spacing_px_(spacing_px) {}

  void Add(const LineSegment& segment_px) { segments_px_.push_back(segment_px); }

  // Returns whether an added line is nearly parallel to the segment, overlaps it and is closer than
  // the spacing.
  bool IsTaken(const LineSegment& segment_px) const;

 private:
  double spacing_px_;
  std::vector<LineSegment> segments_px_;
};

}  // namespace plm_vins

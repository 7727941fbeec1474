// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// The lines of an image, to check whether another line would be a second copy of one of them.
class LineOccupancy {
 public:
  explicit LineOccupancy(double spacing_px) : spacing_px_(spacing_px) {}

  void Add(const LineSegment& segment_px) { segments_px_.push_back(segment_px); }

  // True where a line lies beside the segment, nearly parallel and closer than the spacing.
  bool IsTaken(const LineSegment& segment_px) const;

 private:
  double spacing_px_;
  std::vector<LineSegment> segments_px_;
};

}  // namespace plm_vins

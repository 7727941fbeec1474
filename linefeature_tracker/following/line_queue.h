// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "linefeature_tracker/segments/line_segment.h"
#include "tracking/poorest_bin_queue.h"

namespace plm_vins {

// Distributes selected lines over the image and over directions: Pop() returns the best candidate
// of the region and direction that has the fewest lines.
class LineQueue {
 public:
  explicit LineQueue(const cv::Size& image_size);

  // Candidates must be added best first; Pop() returns their `index`.
  void AddCandidate(const LineSegment& segment_px, size_t index) {
    queue_.AddCandidate(BinOf(segment_px), index);
  }

  // Counts an existing line, or a candidate that was selected.
  void CountLine(const LineSegment& segment_px) { queue_.Count(BinOf(segment_px)); }

  std::optional<size_t> Pop() { return queue_.Pop(); }

 private:
  size_t BinOf(const LineSegment& segment_px) const;

  cv::Size image_size_;
  PoorestBinQueue<size_t> queue_;
};

}  // namespace plm_vins

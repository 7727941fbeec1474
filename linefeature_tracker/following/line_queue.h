// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Spreads a choice of lines over the image and over directions: it is always the turn of the region
// and direction that has the fewest lines, and there of its best candidate.
class LineQueue {
 public:
  explicit LineQueue(const cv::Size& image_size);

  // To be added best first; `index` is what Pop() hands out.
  void AddCandidate(const LineSegment& segment_px, size_t index);

  // A line that exists, or a candidate that was taken.
  void CountLine(const LineSegment& segment_px);

  std::optional<size_t> Pop();

 private:
  struct Bucket {
    std::vector<size_t> candidates;
    size_t next = 0;
    int lines = 0;
  };

  Bucket& BucketOf(const LineSegment& segment_px);

  cv::Size image_size_;
  std::vector<Bucket> buckets_;
};

}  // namespace plm_vins

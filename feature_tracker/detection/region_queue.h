// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "tracking/poorest_bin_queue.h"

namespace plm_vins {

// Distributes selected points over the image: Pop() returns the best candidate of the region that
// has the fewest points.
class RegionQueue {
 public:
  // Divides the image into about `region_count` square regions.
  RegionQueue(const cv::Size& image_size, int region_count);

  // Candidates must be added best first.
  void AddCandidate(const cv::Point2f& position) {
    queue_.AddCandidate(RegionOf(position), position);
  }

  // Counts an existing point, or a candidate that was selected.
  void CountPoint(const cv::Point2f& position) { queue_.Count(RegionOf(position)); }

  std::optional<cv::Point2f> Pop() { return queue_.Pop(); }

 private:
  size_t RegionOf(const cv::Point2f& position) const;

  double region_size_;  // [px]
  int columns_;
  PoorestBinQueue<cv::Point2f> queue_;
};

}  // namespace plm_vins

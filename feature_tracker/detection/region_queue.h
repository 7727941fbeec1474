// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace plm_vins {

// Spreads a choice of points over the image: hands candidates out such that it is always the turn
// of the region that has the fewest points, and there the turn of its best candidate.
class RegionQueue {
 public:
  // About `region_count` square regions.
  RegionQueue(const cv::Size& image_size, int region_count);

  // To be added best first.
  void AddCandidate(const cv::Point2f& position);

  // A point that exists, or a candidate that was taken.
  void CountPoint(const cv::Point2f& position);

  std::optional<cv::Point2f> Pop();

 private:
  struct Region {
    std::vector<cv::Point2f> candidates;
    size_t next = 0;
    int points = 0;
  };

  Region& RegionAt(const cv::Point2f& position);

  double region_size_;  // [px]
  int columns_;
  std::vector<Region> regions_;
};

}  // namespace plm_vins

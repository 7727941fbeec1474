// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/config/config.h"
#include "feature_tracker/detection/spacing_grid.h"
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

// Detects new corners away from existing ones, distributed evenly over the image.
//
// The Shi-Tomasi [Shi1994] or Harris response is computed at half resolution, which takes a quarter
// of the time; corners that only the full resolution shows are hard to track. Refinement then
// locates the corners at full resolution.
class CornerDetector {
 public:
  // `mask` (CV_8UC1 of the image size, non-zero where corners are allowed) may be empty.
  CornerDetector(const PointTrackerConfig& config, cv::Mat mask);

  // Returns at most `max_count` new corners [px], at least min_dist from the `existing` ones and
  // from each other, in order of selection. `pyramid` has the CV_8UC1 image and, if there is one,
  // that of half its resolution. `moving`, a mask in addition to that of the detector, may be
  // empty.
  std::vector<cv::Point2f> Detect(const std::vector<cv::Mat>& pyramid,
                                  const std::vector<cv::Point2f>& existing, int max_count,
                                  const cv::Mat& moving = {}) const;

 private:
  struct Candidate {
    cv::Point2f position;  // at full resolution [px]
    float response = 0;
  };

  float MinResponse(const cv::Mat& response) const;
  std::vector<Candidate> FindCandidates(const std::vector<cv::Mat>& pyramid,
                                        const SpacingGrid& occupied, const cv::Mat& moving) const;
  bool IsAllowed(const cv::Point2f& position, const cv::Size& image_size) const;

  PointTrackerConfig config_;
  cv::Mat mask_;
};

}  // namespace plm_vins

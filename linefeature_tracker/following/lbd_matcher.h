// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/line_descriptor.hpp>
#include <vector>

#include "linefeature_tracker/following/line_gate.h"

namespace plm_vins {

// Matches lines by their binary LBD descriptors [Zhang2013] under a gate around predictions,
// the closer ones preferred.
class LbdMatcher {
 public:
  struct Line {
    LineSegment segment;  // normalised; of the older image: where it is predicted
    cv::Mat descriptor;   // 1 x 32 bytes
  };

  LbdMatcher(const LineTrackerConfig& config, double focal_length);

  // One row of 32 bytes per segment of the CV_8UC1 image [px].
  cv::Mat Describe(const cv::Mat& image, const std::vector<LineSegment>& segments_px) const;

  // For each older line the index of its match, -1 without: the two are each other's best.
  std::vector<int> Match(const std::vector<Line>& older, const std::vector<Line>& newer) const;

 private:
  LineGate gate_;
  double focal_length_;  // [px/rad]
  int max_distance_;     // of descriptors, in bits
  cv::Ptr<cv::line_descriptor::BinaryDescriptor> descriptor_;
};

}  // namespace plm_vins

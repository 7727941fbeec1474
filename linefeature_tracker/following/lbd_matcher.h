// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/line_descriptor.hpp>
#include <vector>

#include "linefeature_tracker/following/line_gate.h"

namespace plm_vins {

// Matches lines by their binary LBD descriptors [Zhang2013] within a gate around predictions, with
// preference for close lines.
class LbdMatcher {
 public:
  struct Line {
    LineSegment segment;  // normalized; for the older image: predicted
    cv::Mat descriptor;   // 1 x 32 bytes
  };

  LbdMatcher(const LineTrackerConfig& config, double focal_length);

  // Returns one row of 32 bytes for each segment [px] of the CV_8UC1 image.
  cv::Mat Describe(const cv::Mat& image, const std::vector<LineSegment>& segments_px) const;

  // Returns for each older line the index of its mutually best match, or -1.
  std::vector<int> Match(const std::vector<Line>& older, const std::vector<Line>& newer) const;

 private:
  LineGate gate_;
  double focal_length_;  // [px/rad]
  int max_distance_;     // Hamming distance of descriptors [bits]
  cv::Ptr<cv::line_descriptor::BinaryDescriptor> descriptor_;
};

}  // namespace plm_vins

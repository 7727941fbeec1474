// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "linefeature_tracker/detection/line_detector.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// A line that the detector found, in both coordinates.
struct FoundLine {
  LineSegment segment;  // normalised, undistorted
  LineSegment segment_px;
  cv::Mat descriptor;  // 1 x 32 bytes; only where LBD matches
};

// Detects the lines of an image: fragments from the detector, only their ends undistorted, joined
// where collinear, filtered by length and border. Good to about a pixel; the brighter side is that
// of Normal(), so edges of opposite sign are not joined.
class LineFinder {
 public:
  LineFinder(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera);

  // Longest first. `pyramid` is the CV_8UC1 image and its halves; `fragments` counts what the
  // detector found.
  std::vector<FoundLine> Find(const std::vector<cv::Mat>& pyramid, int* fragments);

 private:
  std::vector<LineSegment> Undistort(const cv::Mat& image,
                                     const std::vector<LineSegment>& fragments_px,
                                     double scale) const;

  LineTrackerConfig config_;
  std::shared_ptr<const CameraModel> camera_;
  std::unique_ptr<LineDetector> detector_;
  double min_length_px_;
};

}  // namespace plm_vins

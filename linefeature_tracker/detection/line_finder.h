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

// Returns the segment [px] of the CV_8UC1 image, reversed if necessary, such that the brighter side
// is that of its normal. The segment may be off its edge by one pixel.
LineSegment OrientByBrightness(const cv::Mat& image, const LineSegment& segment_px);

// A detected line in normalized and pixel coordinates.
struct FoundLine {
  LineSegment segment;  // normalized, undistorted
  LineSegment segment_px;
};

// Detects the lines of an image: orients the detector's fragments, undistorts their endpoints,
// joins collinear fragments and filters by length and border. Accurate to about one pixel. The
// brighter side is that of Normal(), so edges of opposite polarity are not joined.
class LineFinder {
 public:
  LineFinder(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera);

  // Returns lines in descending order of length. `pyramid` starts with the CV_8UC1 image, each
  // level half the size of the previous one; `fragments` receives the number of detected fragments.
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

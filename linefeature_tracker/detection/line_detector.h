// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "common/config/config.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Detects line segments in an image, to about one pixel. Not const, since OpenCV's detectors keep
// buffers.
class LineDetector {
 public:
  // Creates FLD [Lee2014], LSD [Gioi2010] or EDLines [Akinlar2011]. Throws std::invalid_argument if
  // the installed OpenCV lacks it.
  static std::unique_ptr<LineDetector> Create(LineDetectorType type);
  static bool IsAvailable(LineDetectorType type);

  virtual ~LineDetector() = default;

  // Returns segments of at least `min_length_px` of the CV_8UC1 image [px], in the detector's
  // order. Their directions (start to end) are arbitrary.
  virtual std::vector<LineSegment> Detect(const cv::Mat& image, double min_length_px) = 0;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Tracking result of a line.
struct LineFlowResult {
  LineSegment segment;     // normalized
  double correlation = 0;  // correlation of the profiles across the line in both images, -1 to 1
};

// Lucas-Kanade flow [Lucas1981] of whole lines: aligns brightness profiles across the line between
// images, coarse to fine, over the line's two degrees of freedom and a brightness change. The
// motion along the line is unobservable (aperture problem) and not estimated, so the alignment is
// well conditioned where flow of single points on the line is not.
class LineFlow {
 public:
  using Pyramid = std::vector<cv::Mat>;  // the image, then levels of half the previous size

  explicit LineFlow(std::shared_ptr<const CameraModel> camera) : camera_(std::move(camera)) {}

  static Pyramid BuildPyramid(const cv::Mat& image);

  // Tracks the segment (normalized) from the previous to the current image, starting at
  // `predicted`. Accurate to some tenths of a pixel; refinement handles the finest level. Returns
  // nullopt if too little of the line is visible.
  std::optional<LineFlowResult> Track(const Pyramid& previous, const Pyramid& current,
                                      const LineSegment& segment,
                                      const LineSegment& predicted) const;

 private:
  std::shared_ptr<const CameraModel> camera_;
};

}  // namespace plm_vins

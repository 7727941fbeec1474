// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Where a line went.
struct LineFlowResult {
  LineSegment segment;     // normalised
  double correlation = 0;  // of the brightness across the line before and now, -1 to 1
};

// Lucas-Kanade flow [Lucas1981] of whole lines: the brightness along profiles across the line is
// aligned from image to image, coarse to fine, over the line's two degrees of freedom and a change
// of brightness. The motion along the line, which an edge does not show (the aperture problem), is
// not asked for, so the alignment is well conditioned where the flow of single points is not.
class LineFlow {
 public:
  using Pyramid = std::vector<cv::Mat>;  // the image, then halves of the level before

  explicit LineFlow(std::shared_ptr<const CameraModel> camera) : camera_(std::move(camera)) {}

  static Pyramid BuildPyramid(const cv::Mat& image);

  // Follows the normalised segment of the previous image to the current one, beginning at
  // `predicted`. Accurate to some tenths of a pixel: the finest level is left to refinement.
  // Nothing where too little of it is seen.
  std::optional<LineFlowResult> Track(const Pyramid& previous, const Pyramid& current,
                                      const LineSegment& segment,
                                      const LineSegment& predicted) const;

 private:
  std::shared_ptr<const CameraModel> camera_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Returns the segment [px] of the CV_8UC1 image, reversed if necessary, such that the brighter side
// is that of its normal. The segment may be off its edge by one pixel.
LineSegment OrientByBrightness(const cv::Mat& image, const LineSegment& segment_px);

}  // namespace plm_vins

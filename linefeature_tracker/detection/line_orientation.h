// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// The segment [px] of the CV_8UC1 image, reversed where the brighter side is not that of its
// normal. The segment may be off its edge by a pixel.
LineSegment OrientByBrightness(const cv::Mat& image, const LineSegment& segment_px);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// Returns the straight parts of the edges in a CV_8UC1 image of thin edges [Lee2014]: edges are
// followed from pixel to pixel, and split into parts of at least `min_length_px` whose pixels are
// within 1.4 px of a line. Sets the edges to zero.
std::vector<LineSegment> FindStraightEdges(double min_length_px, cv::Mat* edges);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "linefeature_tracker/segments/line_track.h"

namespace plm_vins {

// Draws the gray image as CV_8UC3 with lines from blue (new) to red (long tracked) and their ids.
// Returns an empty image if `gray` is empty.
cv::Mat DrawLineTracks(const cv::Mat& gray, const std::vector<LineTrack>& tracks);

}  // namespace plm_vins

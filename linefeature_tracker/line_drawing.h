// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "linefeature_tracker/line_track.h"

namespace plm_vins {

// The grey image as CV_8UC3 with its lines, from blue (new) to red (long followed), and their ids.
// Empty where there is no image.
cv::Mat DrawLineTracks(const cv::Mat& gray, const std::vector<LineTrack>& tracks);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "feature_tracker/point_track.h"

namespace plm_vins {

// The grey image as CV_8UC3 with a disc on each corner, from blue (new) to red (long followed), and
// a line that shows where it is going. Empty where there is no image.
cv::Mat DrawPointTracks(const cv::Mat& gray, const std::vector<PointTrack>& tracks);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "feature_tracker/following/point_track.h"

namespace plm_vins {

// Draws the gray image as CV_8UC3 with a disc for each corner, from blue (new) to red (long
// tracked), and a line along its motion. Returns an empty image if `gray` is empty.
cv::Mat DrawPointTracks(const cv::Mat& gray, const std::vector<PointTrack>& tracks);

}  // namespace plm_vins

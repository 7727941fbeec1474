// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

namespace plm_vins {

// Images at the time of a tracked image; empty if there are none.
struct OtherViews {
  cv::Mat second;             // of the second camera of a pair, CV_8UC1
  cv::Mat depth;              // see DepthSample
  double depth_unit = 0.001;  // of its integers [m]
};

}  // namespace plm_vins

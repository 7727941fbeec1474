// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace plm_vins {

// The depth [m] at a pixel of a depth image (as of DepthSample): the median of the 3 x 3 values
// around it. Returns nullopt where the image is empty or ends, or where values are missing or
// differ, as at the edge of an object.
std::optional<double> DepthAt(const cv::Mat& depth, const cv::Point2f& pixel);

}  // namespace plm_vins

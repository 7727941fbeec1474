// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace plm_vins {

// Returns the depth [m] at a pixel of a depth image (see DepthSample), whose integers have the
// given unit [m]: the median of the 3 x 3 values around it. Returns nullopt if the pixel is outside
// the image, or if values are missing or differ, as they do at the edge of an object.
std::optional<double> DepthAt(const cv::Mat& depth, const cv::Point2f& pixel, double unit);

}  // namespace plm_vins

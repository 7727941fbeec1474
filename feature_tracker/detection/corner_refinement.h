// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace plm_vins {

constexpr int kRefinementRadius_px = 5;  // the window is a square of 2 * 5 + 1 pixels

// The subpixel position of the corner near `start` [px]: the point q at which every gradient g(p)
// of the window is at right angles to p - q, found by iterating the weighted least squares sum w g
// g^T (p - q) = 0 ([Paper], section III.A). Nothing under the image border constraint: where the
// window (and the pixel around it that its gradients take) leaves the image, or the corner leaves
// the window around `start`; nothing either where the gradients fix no point.
//
// cv::cornerSubPix solves the same equations but hands a corner that left its window back
// unrefined, so that it looks like a good one.
std::optional<cv::Point2f> RefineCorner(const cv::Mat& image, const cv::Point2f& start);

// True where the refinement window around the point is inside of the image.
bool IsRefinementWindowInside(const cv::Size& image_size, const cv::Point2f& point);

}  // namespace plm_vins

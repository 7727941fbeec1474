// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace plm_vins {

constexpr int kRefinementRadius_px = 5;  // the window has 2 * 5 + 1 pixels on each side

// Refines the corner near `start` [px] to subpixel accuracy: finds the point q for which each
// gradient g(p) of the window is perpendicular to p - q, by iterating the weighted least squares
// sum w g g^T (p - q) = 0 ([Paper], section III.A). Returns nullopt under the image border
// constraint, that is if the window (plus the margin of its gradients) leaves the image or the
// corner leaves the window around `start`, and if the gradients are degenerate.
//
// cv::cornerSubPix solves the same equations, but returns a corner that left its window unrefined,
// so that it is indistinguishable from a good one.
std::optional<cv::Point2f> RefineCorner(const cv::Mat& image, const cv::Point2f& start);

// Returns whether the refinement window around the point is inside the image.
bool IsRefinementWindowInside(const cv::Size& image_size, const cv::Point2f& point);

}  // namespace plm_vins

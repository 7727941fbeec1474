// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "common/config/config.h"

namespace plm_vins {

// Computes the corner response of each pixel of a CV_8UC1 image of at least 2 x 2 pixels, as CV_32F
// of the same size. It is the smallest eigenvalue [Shi1994], or Harris' measure with k = 0.04, of
// the gradient covariance in a 3 x 3 block (Sobel gradients in units of the full grey range; the
// image is reflected at its border). Equals cv::cornerMinEigenVal() and cv::cornerHarris(), but
// sums integers in one pass, which takes half the time.
cv::Mat CornerResponse(const cv::Mat& image, CornerDetectorType type);

}  // namespace plm_vins

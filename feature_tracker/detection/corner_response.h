// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "common/config/config.h"

namespace plm_vins {

// How much of a corner each pixel of a CV_8UC1 image of at least 2 x 2 pixels is, CV_32F of the
// same size: from the covariance of the gradients in the 3 x 3 pixels around it (Sobel's, in units
// of the full grey range; the image is reflected at its border), its least eigenvalue [Shi1994] or
// Harris' measure with k = 0.04. As cv::cornerMinEigenVal() and cv::cornerHarris() have it, but
// summed in integers and in one pass, which takes half of the time.
cv::Mat CornerResponse(const cv::Mat& image, CornerDetectorType type);

}  // namespace plm_vins

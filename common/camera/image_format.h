// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "common/camera/camera_model.h"

namespace plm_vins {

// Throws std::invalid_argument with the actual format if the image is not CV_8UC1 of the calibrated
// size.
void CheckImageFormat(const cv::Mat& gray, const CameraParameters& camera);

// Throws std::invalid_argument unless the image is CV_16UC1 or CV_32FC1 of the calibrated size.
void CheckDepthFormat(const cv::Mat& depth, const CameraParameters& camera);

}  // namespace plm_vins

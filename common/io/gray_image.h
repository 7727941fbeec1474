// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/imgcodecs.hpp>

namespace plm_vins {

// Flags for reading a gray image with its rows as the camera delivered them: the calibration does
// not apply to an image rotated by the orientation tag of its file.
constexpr int kReadGrayAsStored = cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION;

}  // namespace plm_vins

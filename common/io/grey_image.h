// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/imgcodecs.hpp>

namespace plm_vins {

// Reads an image as grey levels, its rows as the camera gave them: a calibration knows nothing of
// the orientation that a camera notes in the file.
constexpr int kReadGreyAsStored = cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION;

}  // namespace plm_vins

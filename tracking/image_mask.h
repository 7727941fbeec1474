// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace plm_vins {

// The mask of the image file that the key fisheye_mask names, CV_8UC1 with 255 where features are
// allowed and 0 elsewhere; empty where `file` is. What is darker than half is masked: lossy files
// are not black and white only. Throws std::invalid_argument, which names key and file, where that
// cannot be read, is not of the images' size, or allows nothing.
cv::Mat ReadMask(const std::string& file, const cv::Size& image_size);

// False where the mask forbids the pixel, which is of the image. An empty one forbids none.
inline bool MaskAllows(const cv::Mat& mask, const cv::Point& pixel) {
  return mask.empty() || mask.at<uint8_t>(pixel) != 0;
}

}  // namespace plm_vins

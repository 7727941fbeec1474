// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace plm_vins {

// Reads the image file of the key fisheye_mask as CV_8UC1 with 255 where features are allowed and 0
// elsewhere. Returns an empty mask if `file` is empty. Pixels darker than half are masked, since
// lossy files are not purely black and white. Throws std::invalid_argument with key and file name
// if the file cannot be read, has another size, or masks everything.
cv::Mat ReadMask(const std::string& file, const cv::Size& image_size);

// Returns whether the mask allows the pixel, which must be inside the image. An empty mask allows
// all.
inline bool MaskAllows(const cv::Mat& mask, const cv::Point& pixel) {
  return mask.empty() || mask.at<uint8_t>(pixel) != 0;
}

}  // namespace plm_vins

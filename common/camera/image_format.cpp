// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/image_format.h"

#include <stdexcept>
#include <string>

namespace plm_vins {

void CheckImageFormat(const cv::Mat& gray, const CameraParameters& camera) {
  if (gray.type() != CV_8UC1) throw std::invalid_argument("image is not 8-bit grey (CV_8UC1)");
  if (gray.cols == camera.width && gray.rows == camera.height) return;
  throw std::invalid_argument("image is " + std::to_string(gray.cols) + " x " +
                              std::to_string(gray.rows) + " px, the calibration is for " +
                              std::to_string(camera.width) + " x " + std::to_string(camera.height) +
                              " (image_width, image_height)");
}

}  // namespace plm_vins

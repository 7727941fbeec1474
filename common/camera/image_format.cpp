// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/image_format.h"

#include <stdexcept>
#include <string>

namespace plm_vins {

namespace {

void CheckSize(const char* what, const cv::Mat& image, const CameraParameters& camera) {
  if (image.cols == camera.width && image.rows == camera.height) return;
  throw std::invalid_argument(std::string(what) + " is " + std::to_string(image.cols) + " x " +
                              std::to_string(image.rows) + " px, but the calibration is for " +
                              std::to_string(camera.width) + " x " + std::to_string(camera.height) +
                              " (image_width, image_height)");
}

}  // namespace

void CheckImageFormat(const cv::Mat& gray, const CameraParameters& camera) {
  if (gray.type() != CV_8UC1) throw std::invalid_argument("image is not 8-bit gray (CV_8UC1)");
  CheckSize("image", gray, camera);
}

void CheckDepthFormat(const cv::Mat& depth, const CameraParameters& camera) {
  if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1) {
    throw std::invalid_argument("depth is neither 16UC1 [mm] nor 32FC1 [m]");
  }
  CheckSize("depth image", depth, camera);
}

}  // namespace plm_vins

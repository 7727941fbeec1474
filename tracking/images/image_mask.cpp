// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/images/image_mask.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "common/io/gray_image.h"

namespace plm_vins {
namespace {

constexpr double kDark = 127;

std::string ToText(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

cv::Mat ReadMask(const std::string& file, const cv::Size& image_size) {
  if (file.empty()) return {};
  cv::Mat mask = cv::imread(file, kReadGrayAsStored);
  if (mask.empty()) throw std::invalid_argument("fisheye_mask: cannot read the image " + file);
  if (mask.size() != image_size) {
    throw std::invalid_argument("fisheye_mask: " + file + " has " + ToText(mask.size()) +
                                " pixels, but image_width and image_height are " +
                                ToText(image_size));
  }
  cv::threshold(mask, mask, kDark, 255, cv::THRESH_BINARY);
  if (cv::countNonZero(mask) == 0) {
    throw std::invalid_argument("fisheye_mask: " + file +
                                " is dark everywhere: make it white where features are allowed");
  }
  return mask;
}

}  // namespace plm_vins

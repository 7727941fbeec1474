// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/images/image_check.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "common/camera/image_format.h"

namespace plm_vins {

void CheckImage(const ImageSample& image, const CameraParameters& camera,
                const std::optional<int64_t>& previous_ns) {
  CheckImageFormat(image.gray, camera);
  if (previous_ns && image.t_ns <= *previous_ns) {
    throw std::invalid_argument("image stamp " + std::to_string(image.t_ns) +
                                " ns is not after the previous one, " +
                                std::to_string(*previous_ns) + " ns");
  }
}

bool AreSame(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size()) return false;
  for (int row = 0; row < a.rows; ++row) {
    if (!std::equal(a.ptr(row), a.ptr(row) + a.cols, b.ptr(row))) return false;
  }
  return true;
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/image_check.h"

#include <stdexcept>
#include <string>

namespace plm_vins {

void CheckImage(const ImageSample& image, const CameraParameters& camera,
                const std::optional<int64_t>& previous_ns) {
  if (image.gray.type() != CV_8UC1) {
    throw std::invalid_argument("image is not 8-bit grey (CV_8UC1)");
  }
  if (image.gray.cols != camera.width || image.gray.rows != camera.height) {
    throw std::invalid_argument("image is " + std::to_string(image.gray.cols) + " x " +
                                std::to_string(image.gray.rows) + " px, the calibration is for " +
                                std::to_string(camera.width) + " x " +
                                std::to_string(camera.height) + " (image_width, image_height)");
  }
  if (previous_ns && image.t_ns <= *previous_ns) {
    throw std::invalid_argument("image stamp " + std::to_string(image.t_ns) +
                                " ns is not after the one before, " + std::to_string(*previous_ns) +
                                " ns");
  }
}

}  // namespace plm_vins

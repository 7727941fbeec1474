// SPDX-License-Identifier: BSD-3-Clause
// Images of further sensors that belong to a camera image.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>

#include "common/measurements.h"

namespace plm_vins {

// Image of the depth along the optical axis, registered to the camera: its size and lens apply.
struct DepthSample {
  int64_t t_ns = 0;
  cv::Mat depth;  // CV_16UC1 [mm], 0 if unknown, or CV_32FC1 [m]; read only
  std::shared_ptr<const void> owner = {};  // owner of the pixels if `depth` is not; keep both
};

// Images with the timestamp of a camera image; one that is missing has no pixels.
struct ImageCompanions {
  ImageSample right;  // image of the second camera C1
  DepthSample depth;
};

}  // namespace plm_vins

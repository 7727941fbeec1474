// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "tracking/image_sampling.h"

namespace plm_vins {

// Brightness across a line, from -radius to radius [px] along its unit `normal`, into the
// 2 radius + 1 values of `profile`. False, and nothing read, where that leaves the image.
inline bool ReadProfile(const cv::Mat& image, const Eigen::Vector2f& center,
                        const Eigen::Vector2f& normal, int radius, float* profile) {
  if (!IsInterpolable(image, center.x(), center.y(), static_cast<float>(radius))) return false;
  for (int j = -radius; j <= radius; ++j) {
    const auto distance = static_cast<float>(j);
    profile[j + radius] =
        Interpolate(image, center.x() + distance * normal.x(), center.y() + distance * normal.y());
  }
  return true;
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "tracking/images/image_sampling.h"

namespace plm_vins {

// Brightness profile across a line, padded with zeros.
using LineProfile = Eigen::Array<float, 16, 1>;
constexpr int kMaxProfileRadius = 7;  // [px]
static_assert(2 * kMaxProfileRadius + 1 <= LineProfile::SizeAtCompileTime);

// Samples the profile from -radius to radius [px] along the line's unit `normal`. Returns false,
// without reading, if it leaves the image.
inline bool ReadProfile(const cv::Mat& image, const Eigen::Vector2f& center,
                        const Eigen::Vector2f& normal, int radius, LineProfile* profile) {
  constexpr float kRounding_px = 0.01F;
  const auto reach = static_cast<float>(radius);
  if (!IsInterpolable(image, center.x(), center.y(), reach + kRounding_px)) return false;
  const Eigen::Vector2f start = center - reach * normal;
  InterpolateRow<LineProfile::SizeAtCompileTime>(
      image, {start.x(), start.y()}, {normal.x(), normal.y()}, 2 * radius + 1, profile->data());
  return true;
}

}  // namespace plm_vins

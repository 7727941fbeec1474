// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>

namespace plm_vins {

// Returns the color (BGR) of a feature that has been tracked for `length` images: from blue (new)
// to red (long tracked).
inline cv::Scalar AgeColor(int length) {
  constexpr int kOldLength = 20;  // pure red from here on
  const double age = std::min(1.0, static_cast<double>(length) / kOldLength);
  return {255 * (1 - age), 0, 255 * age};
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>

namespace plm_vins {

// How trackers paint a feature that has been followed for `length` images (BGR): from blue, new, to
// red, long followed.
inline cv::Scalar AgeColor(int length) {
  constexpr int kOldLength = 20;  // fully red from here on
  const double age = std::min(1.0, static_cast<double>(length) / kOldLength);
  return {255 * (1 - age), 0, 255 * age};
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// One line that is being followed, as of the newest image. The brighter side is that of Normal().
struct LineTrack {
  int64_t id = -1;
  int length = 1;          // images it was seen in
  LineSegment segment;     // normalised, undistorted
  LineSegment segment_px;  // raw pixels
  // Normalised motion across the line since the image before, the turn taken out.
  Eigen::Vector2d parallax = Eigen::Vector2d::Zero();
  cv::Mat descriptor;  // 1 x 32 bytes; only where LBD matches
};

}  // namespace plm_vins

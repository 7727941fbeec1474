// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/measurements.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// A line in the image of the second camera of a pair. Its ends need not correspond to those in the
// first one.
struct SecondSegment {
  LineSegment segment;  // normalized, undistorted
  // Standard deviation of both ends across the line. The closer the line is to the epipolar
  // direction, the larger it is.
  double deviation = 0;
};

// A tracked line in the newest image. The brighter side is that of Normal().
struct LineTrack {
  int64_t id = -1;
  int length = 1;          // number of images that it was observed in
  LineSegment segment;     // normalized, undistorted
  LineSegment segment_px;  // raw pixels
  // Motion across the line since the previous image (normalized), with the camera rotation removed.
  Eigen::Vector2d parallax = Eigen::Vector2d::Zero();
  std::optional<SecondSegment> second;            // if matched in the newest image
  std::optional<Eigen::Vector2d> inverse_depths;  // at start and end, from the last match [1/m]
};

}  // namespace plm_vins

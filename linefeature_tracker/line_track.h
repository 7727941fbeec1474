// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/measurements.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// A tracked line in the newest image. The brighter side is that of Normal().
struct LineTrack {
  int64_t id = -1;
  int length = 1;          // number of images that it was observed in
  LineSegment segment;     // normalized, undistorted
  LineSegment segment_px;  // raw pixels
  // Motion across the line since the previous image (normalized), with the camera rotation removed.
  Eigen::Vector2d parallax = Eigen::Vector2d::Zero();
  std::optional<RightSegment> right;              // see LineObservation
  std::optional<Eigen::Vector2d> inverse_depths;  // at start and end, from the last match [1/m]
};

}  // namespace plm_vins

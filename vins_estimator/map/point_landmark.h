// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vins_estimator/geometry/point_in_host.h"
#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

// Observation of a point landmark in one image.
struct PointView {
  int64_t t_ns = 0;  // identifies the frame
  TimedBearing bearing;
};

// A corner track over the frames of the window, and the point in space. The first observation is
// the host, in whose camera frame the coordinates are.
struct PointLandmark {
  int64_t id = -1;
  std::vector<PointView> views;  // by time
  // Normalized image point and inverse depth [1/m] in the host camera, see PointInHost.
  std::array<double, kPointSize> coordinates = {0, 0, 0};
  bool triangulated = false;

  const PointView& host() const { return views.front(); }
};

}  // namespace plm_vins

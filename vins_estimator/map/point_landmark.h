// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vins_estimator/geometry/point_in_host.h"
#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

// One image's view of a landmark.
struct PointView {
  int64_t t_ns = 0;  // names the frame
  TimedBearing bearing;
};

// A corner track over the frames of the window, and the point in space behind it. The first view is
// the host that the coordinates refer to.
struct PointLandmark {
  int64_t id = -1;
  std::vector<PointView> views;  // by time
  // Normalised image point and inverse depth [1/m] in the host camera, see PointInHost.
  std::array<double, kPointSize> coordinates = {0, 0, 0};
  bool triangulated = false;

  const PointView& host() const { return views.front(); }
};

}  // namespace plm_vins

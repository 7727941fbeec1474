// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/geometry/point_in_host.h"
#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

// Observation of a point landmark in one image.
struct PointView {
  int64_t t_ns = 0;  // identifies the frame
  TimedBearing bearing;
  std::optional<Eigen::Vector2d> right = {};  // normalized, in the second camera at the same time
  std::optional<double> depth = {};           // measured, along the optical axis [m]

  // Returns the observation in the second camera, which moves in its image as in the first.
  TimedBearing RightBearing() const {
    TimedBearing bearing_C1 = bearing;
    bearing_C1.xy = *right;
    return bearing_C1;
  }
  void ForgetDepth() {
    right.reset();
    depth.reset();
  }
  int CountMeasurements() const { return 1 + right.has_value() + depth.has_value(); }
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

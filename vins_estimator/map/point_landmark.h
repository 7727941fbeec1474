// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/geometry/point_in_host.h"
#include "vins_estimator/geometry/timed_bearing.h"
#include "vins_estimator/map/image_key.h"

namespace plm_vins {

// A corner track over the frames of the window, and the point in space. The first observation is
// the host, in whose camera frame the coordinates are.
struct PointLandmark {
  struct Observation : ImageKey {
    TimedBearing bearing;
    std::optional<double> depth = {};                       // measured, along the optical axis [m]
    Eigen::Vector2d depth_slope = Eigen::Vector2d::Zero();  // of the inverse depth (DepthSlopes)

    int CountMeasurements() const { return 1 + depth.has_value(); }
    void ForgetDepth() { depth.reset(); }
  };

  int64_t id = -1;
  std::vector<Observation> observations;  // by time and camera
  // Normalized image point and inverse depth [1/m] in the host camera, see PointInHost.
  std::array<double, kPointSize> coordinates = {0, 0, 0};
  bool triangulated = false;

  const Observation& host() const { return observations.front(); }
};

}  // namespace plm_vins

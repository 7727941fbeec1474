// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "common/geometry/rigid3.h"
#include "common/measurements.h"

namespace plm_vins {

// An image becomes a keyframe if it differs from the previous keyframe by at least one of these.
struct KeyframeSpacing {
  double distance = 0.2;  // [m]
  double angle = 0.2;     // [rad]
  double time = 2.0;      // [s]
};

inline bool IsApart(const KeyframeSpacing& spacing, int64_t last_ns, const Rigid3d& T_O_last,
                    int64_t t_ns, const Rigid3d& T_O_B) {
  return (T_O_B.translation - T_O_last.translation).norm() >= spacing.distance ||
         T_O_B.rotation.angularDistance(T_O_last.rotation) >= spacing.angle ||
         ToSeconds(t_ns - last_ns) >= spacing.time;
}

}  // namespace plm_vins

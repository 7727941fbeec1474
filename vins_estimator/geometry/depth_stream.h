// SPDX-License-Identifier: BSD-3-Clause
// Calibration of a stream of depth images: [logarithm of the scale factor (1), delay (1) [s]]. A
// point at z(t) is measured as
//   d(t) = exp(scale) z(t - delay).
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace plm_vins {

constexpr int kDepthStreamSize = 2;

// Measured depth of a point.
struct TimedDepth {
  double depth = 0;       // along the optical axis [m]
  double approach = 0.0;  // velocity of the camera along its axis at that time [m/s]

  // Inverse depth that a stream of this calibration measures for a point of `inverse_depth` [1/m].
  double Expected(double inverse_depth, const double* stream) const {
    return std::exp(-stream[0]) * inverse_depth * (1 - stream[1] * approach * inverse_depth);
  }
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
// Calibration of a stream of depth images: [logarithm of the scale factor (1), delay (1) [s],
// shift (2), zoom (1)]. The depth image has at a normalized image point x at the time t what the
// camera sees at x + shift + zoom x at the time t - delay. This holds to first order, where the
// inverse depth has a slope.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace plm_vins {

constexpr int kDepthStreamSize = 5;
using DepthStream = Eigen::Matrix<double, kDepthStreamSize, 1>;

// Measured depth of a point.
struct TimedDepth {
  double depth = 0;       // along the optical axis [m]
  double approach = 0.0;  // velocity of the camera along its axis at that time [m/s]
  // Derivative of the inverse depth of the scene by the normalized image point [1/m].
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();        // normalized
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // of the point in the image [1/s]

  // Inverse depth that a stream of this calibration measures for a point of `inverse_depth` [1/m].
  double Expected(double inverse_depth, const double* stream) const {
    const Eigen::Vector2d moved(stream[2] + stream[4] * xy.x() + stream[1] * velocity.x(),
                                stream[3] + stream[4] * xy.y() + stream[1] * velocity.y());
    return std::exp(-stream[0]) *
           (inverse_depth * (1 - stream[1] * approach * inverse_depth) + slope.dot(moved));
  }

  // Its derivative by the calibration.
  Eigen::Matrix<double, 1, kDepthStreamSize> ByStream(double inverse_depth,
                                                      const double* stream) const {
    const double scale = std::exp(-stream[0]);
    Eigen::Matrix<double, 1, kDepthStreamSize> result;
    result << -Expected(inverse_depth, stream),
        scale * (slope.dot(velocity) - approach * inverse_depth * inverse_depth), scale * slope.x(),
        scale * slope.y(), scale * slope.dot(xy);
    return result;
  }
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {

// Measures the jitter of image timestamps. A timestamp error makes the camera observe more rotation
// than the gyroscope integrates before the image, by the rate times the error, and less by the same
// amount after it. Other errors are not aligned with the rotation axis; a delay or a bias, which
// are, have the same sign in both intervals.
class StampJitterMonitor {
 public:
  // `rotation_residual` is the rotation between two images minus the gyroscope's [rad], `rate` the
  // gyroscope's rate at the second image [rad/s].
  void Add(const Eigen::Vector3d& rotation_residual, const Eigen::Vector3d& rate);

  // Skips an interval without information: the next one is not compared with earlier ones.
  void Skip();

  // Standard deviation of a timestamp error [s]; zero if it is not significant.
  double deviation() const;

 private:
  // Exponentially forgetting sums: the squared residuals along and across the rotation axis,
  // weighted by the squared rate; the covariance of consecutive residuals along the axis; and the
  // product of their squared rates.
  double along_ = 0, across_ = 0, common_ = 0, squared_rates_ = 0;
  double along_before_ = 0, squared_rate_before_ = 0;  // terms of the previous interval
};

// Returns the effect of timestamp errors with the given standard deviation [s] on the states at
// both ends of an interval. `gravity_W` is (0, 0, -g).
StampErrors StampErrorsOf(double deviation, const Preintegration& motion,
                          const Eigen::Vector3d& gravity_W, const FrameState& start,
                          const FrameState& end);

}  // namespace plm_vins

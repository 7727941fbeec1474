// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {

// Measures by how much the stamps of images jitter. An error of a stamp makes the camera see more
// of the turn than the gyro has integrated before it, by the rate times the error, and as much less
// after it. What else is wrong does not keep to the axis of the turn; a delay or a bias, which do,
// have the same sign in both intervals.
class StampJitterMonitor {
 public:
  // `rotation_residual` [rad]: the turn between two images beyond the gyro's; `rate` [rad/s]: the
  // gyro's at the second one.
  void Add(const Eigen::Vector3d& rotation_residual, const Eigen::Vector3d& rate);

  // An interval that says nothing: the next one has nothing in common with those before.
  void Skip();

  // Standard deviation of a stamp's error [s]; zero where there is none to be seen.
  double deviation() const;

 private:
  // Sums that forget: of the squared residual along the turn and across it, each weighed with the
  // squared rate, of what the one along has in common with that of the interval before, and of the
  // squared rates of both.
  double along_ = 0, across_ = 0, common_ = 0, squared_rates_ = 0;
  double along_before_ = 0, squared_rate_before_ = 0;  // of the interval before
};

// Of the interval between two images the stamps of which err by this deviation [s]. `gravity_W` is
// (0, 0, -g).
StampErrors StampErrorsOf(double deviation, const Preintegration& motion,
                          const Eigen::Vector3d& gravity_W, const FrameState& start,
                          const FrameState& end);

}  // namespace plm_vins

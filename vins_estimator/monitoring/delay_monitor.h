// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace plm_vins {

// Detects an error d of the time offset td between camera and IMU. The gyroscope is then integrated
// from d too early or too late, so its rotation differs from the camera's by d times the change of
// angular rate over the interval. Other errors are not correlated with that change.
class DelayMonitor {
 public:
  // `rotation_residual` is the rotation between two images minus the gyroscope's [rad],
  // `rate_change` the angular rate at the second image minus that at the first [rad/s].
  void Add(const Eigen::Vector3d& rotation_residual, const Eigen::Vector3d& rate_change);

  // Returns the approximate error of td [s], without the part that the optimization has absorbed;
  // nullopt if it is not significant.
  std::optional<double> delay() const;

 private:
  // Exponentially forgetting sums of products of rate change and residual.
  double change_residual_ = 0, change_change_ = 0, residual_residual_ = 0;
};

}  // namespace plm_vins

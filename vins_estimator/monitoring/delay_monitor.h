// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace plm_vins {

// Notices that the images are stamped too late or too early. An error d of td makes the gyro
// integrate the turn from d earlier or later than the camera saw it, so that the two differ by d
// times the change of the rate over the interval; other errors do not follow that change.
class DelayMonitor {
 public:
  // `rotation_residual` [rad]: the turn between two images beyond the gyro's; `rate_change`
  // [rad/s]: the rate at the second one less that at the first.
  void Add(const Eigen::Vector3d& rotation_residual, const Eigen::Vector3d& rate_change);

  // The error of td [s], roughly: what the optimisation has given in to is missing. Nothing where
  // there is none to be seen.
  std::optional<double> delay() const;

 private:
  // Sums that forget: of products of change and residual.
  double change_residual_ = 0, change_change_ = 0, residual_residual_ = 0;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/monitoring/imu_monitor.h"
#include "vins_estimator/monitoring/stamp_jitter.h"

namespace plm_vins {

// Re-weights an interval that contradicts the camera: with more noise, and with bias steps allowed.
void DoubtInterval(const ImuNoise& noise, Preintegration* motion);

// Checks whether IMU and camera agree on the motion between images, and finds the cause if they do
// not: noise, a bias step, or timestamps of images that jitter.
class ImuAgreement {
 public:
  // Adds the newest interval of an optimized window and the inlier counts of the newest image.
  // Returns the factor on the variance of its noise if the interval must be doubted
  // (DoubtInterval), otherwise nullopt.
  std::optional<double> Add(const SlidingWindow& window, const PointMap::Fit& fit);

  // Returns whether IMU and camera agree: no noise scale is active, and the intervals of an
  // optimized window after `t_ns` have small residuals.
  bool IsUndoubted(const SlidingWindow& window, int64_t t_ns) const;

  // Factor on the variance of the IMU noise in the next interval; 1 if the noise is correct.
  double noise_scale() const { return imu_monitor_.noise_scale(); }

  // Standard deviation of the image timestamps [s]; zero if it is not significant.
  double stamp_deviation() const { return stamp_jitter_.deviation(); }

 private:
  void AddTurn(const Preintegration& motion, const Eigen::Vector3d& residual);

  ImuMonitor imu_monitor_;
  StampJitterMonitor stamp_jitter_;
};

}  // namespace plm_vins

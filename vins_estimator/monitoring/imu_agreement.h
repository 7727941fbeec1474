// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/monitoring/delay_monitor.h"
#include "vins_estimator/monitoring/imu_monitor.h"
#include "vins_estimator/monitoring/stamp_jitter.h"

namespace plm_vins {

// Weighs an interval that contradicts the camera anew: with more noise, and with biases free to
// step.
void DoubtInterval(const ImuNoise& noise, Preintegration* motion);

// Whether IMU and camera agree on the motion from image to image, and if not, what may be the
// cause: noise, a bias that stepped, or stamps of images that are late or jitter.
class ImuAgreement {
 public:
  // Takes the newest interval of a window that was solved for, and how the known points of the
  // newest image fit. Where the interval is to be doubted: by how much to scale the variance of its
  // noise.
  std::optional<double> Add(const SlidingWindow& window, const PointMap::Fit& fit);

  // Nothing contradicts, neither before nor in the intervals after `t_ns` of a window, the states
  // of which were solved for.
  bool IsUndoubted(const SlidingWindow& window, int64_t t_ns) const;

  // By how much to scale the variance of the IMU's noise in the next interval; 1 where it fits.
  double noise_scale() const { return imu_monitor_.noise_scale(); }

  // The error of td [s], roughly; nothing where there is none to be seen.
  std::optional<double> delay() const { return delay_monitor_.delay(); }

  // Standard deviation of an image's stamp [s]; zero where there is no error to be seen.
  double stamp_deviation() const { return stamp_jitter_.deviation(); }

 private:
  void AddTurn(const Preintegration& motion, const Eigen::Vector3d& residual);

  ImuMonitor imu_monitor_;
  DelayMonitor delay_monitor_;
  StampJitterMonitor stamp_jitter_;
};

}  // namespace plm_vins

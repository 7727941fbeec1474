// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "common/config/sensor_config.h"
#include "common/measurements.h"
#include "vins_estimator/initialization/extrinsic_calibrator.h"

namespace plm_vins {

// Compares rotations of the camera with those of the gyroscope while the estimate is in doubt, and
// finds out whether the camera is mounted in another way than configured.
class RotationCheck {
 public:
  // `point_noise_px` is the standard deviation of a corner.
  RotationCheck(const SensorConfig& sensor, double point_noise_px);

  // Adds the next image. Without a gap in the IMU samples, it must follow the last one.
  void Add(const FrameMeasurement& measurement);

  // Drops the images, but not the finding. To be called if the next image does not follow.
  void Interrupt() { frames_.clear(); }

  // Returns what is wrong, with the key and what to do; empty if nothing is, or if too few
  // rotations were observed.
  const std::string& finding() const { return finding_; }

 private:
  void JudgeMounting(const Eigen::Quaterniond& R_B_C);

  std::optional<Eigen::Quaterniond> R_B_C_;  // configured; nullopt if it is to be calibrated
  ExtrinsicCalibrator calibrator_;
  std::deque<FrameMeasurement> frames_;
  std::string finding_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/config/sensor_config.h"
#include "common/finding.h"
#include "common/measurements.h"
#include "vins_estimator/rotation_calibration/gross_errors.h"
#include "vins_estimator/rotation_calibration/rotation_fit.h"
#include "vins_estimator/rotation_calibration/stamp_lag.h"

namespace plm_vins {

// Compares the rotations of a camera with those of the gyroscope, which needs no estimate, and
// tells which part of the calibration is wrong. Pairs of images are rare while nothing is in doubt,
// as their relative pose takes time.
class RotationCheck {
 public:
  // `point_noise_px` is the standard deviation of a corner.
  RotationCheck(const SensorConfig& sensor, int camera, double point_noise_px);

  // Adds the next image.
  void Add(const FrameMeasurement& measurement, bool in_doubt);

  // Returns what is wrong, with the key and what to do; empty if nothing is, or if too few
  // rotations were observed.
  const std::string& finding() const { return finding_.text; }
  const RankedFinding& ranked_finding() const { return finding_; }

  // Returns whether the inverse of the configured rotation fits.
  bool is_inverted() const { return mounting_ && mounting_->kind == MountingError::Kind::kInverse; }

  // Relative error that was found and is not refined: that of the rotation [rad], of the lens, or
  // of the gyro. It makes the scale wrong by about as much.
  double error() const { return error_; }

  // Returns whether the rotations agree: an error of the calibration is not one of them.
  bool agrees() const { return agrees_; }

 private:
  void Judge(const Eigen::Quaterniond& R_B_C);
  bool FindLag();
  // Returns whether the rotation is grossly wrong.
  bool FindGrossError(const Eigen::Quaterniond& R_B_C);
  RotationFit Explain(const Eigen::Quaterniond& R_B_C) const;
  bool IsRefined(const RotationFit& fit) const;

  const SensorConfig sensor_;
  const int camera_;
  const double focal_length_;  // [px]
  const double noise_;         // of a normalized coordinate
  std::deque<FrameMeasurement> frames_;
  std::vector<RotationPair> pairs_;  // oldest first
  StampLag lag_;
  std::optional<int64_t> measured_ns_;  // newest image of the last pair
  int64_t measured_ = 0;                // number of pairs so far
  RankedFinding finding_;
  double error_ = 0;
  std::optional<MountingError> mounting_;
  bool agrees_ = false, mounting_was_wrong_ = false;
};

}  // namespace plm_vins

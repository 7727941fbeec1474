// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/rotation_check.h"

#include <cmath>
#include <optional>
#include <string>

#include "common/camera/camera_model.h"
#include "common/format.h"
#include "vins_estimator/imu/imu_gap.h"

namespace plm_vins {
namespace {

constexpr double kHistory = 0.5;            // more than the interval of a pair of images [s]
constexpr double kMaxMountingError = 0.17;  // [rad]; refined from smaller errors

}  // namespace

RotationCheck::RotationCheck(const SensorConfig& sensor, double point_noise_px)
    : calibrator_(sensor.imu_noise,
                  point_noise_px / CameraModel::Create(sensor.camera)->FocalLength()) {
  if (sensor.estimate_extrinsic == SensorConfig::ExtrinsicMode::kCalibrateRotation) return;
  R_B_C_ = sensor.T_B_C.rotation;
}

void RotationCheck::Add(const FrameMeasurement& measurement) {
  if (!frames_.empty() && LeaveGap(measurement.imu)) frames_.clear();
  frames_.push_back(measurement);
  while (ToSeconds(measurement.t_ns - frames_.front().t_ns) > kHistory) frames_.pop_front();
  if (frames_.size() == 1) return;
  std::string reason;
  const auto R_B_C = calibrator_.Add(frames_, &reason);
  if (!R_B_C) return;
  finding_.clear();
  JudgeMounting(*R_B_C);
}

void RotationCheck::JudgeMounting(const Eigen::Quaterniond& R_B_C) {
  const double error = R_B_C_ ? R_B_C.angularDistance(*R_B_C_) : 0;
  if (error < kMaxMountingError) return;
  finding_ = Format(
      "extrinsicRotation is wrong by %.0f deg, by the rotations of camera and gyro: is it the "
      "inverse, or of an image that is turned? estimate_extrinsic: 2 finds the right one",
      error * 180 / M_PI);
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/rotation_check.h"

#include <cmath>

#include "common/camera/camera_model.h"
#include "common/format.h"
#include "common/geometry/so3.h"
#include "common/imu/imu_gap.h"
#include "vins_estimator/rotation_calibration/rotation_pair.h"

namespace plm_vins {
namespace {

using Cause = RotationFit::Cause;

constexpr double kHistory = 0.5;                       // more than the interval of a pair [s]
constexpr double kStride = 0.3, kStrideInDoubt = 0.1;  // between pairs [s]
constexpr size_t kMaxPairs = 200;
constexpr int64_t kJudgedPairs = 10;          // between judgements
constexpr double kMaxExtrinsicsError = 0.17;  // [rad]; larger errors are not linear
constexpr char kBy[] = ", by the rotations of camera and gyro";

std::string Describe(const RotationFit& fit) {
  switch (fit.cause) {
    case Cause::kTimeOffset:
      return Format("td is wrong by %+.0f ms%s: add this to td, or estimate_td: 1",
                    1e3 * fit.amount, kBy);
    case Cause::kFocalLength:
      return Format(
          "the focal length is wrong by about %+.0f %%%s: calibrate the camera at this resolution, "
          "or estimate_intrinsics: 1 with a focal_length_deviation as large",
          100 * fit.amount, kBy);
    case Cause::kExtrinsics:
      return Format("extrinsicRotation is wrong by %.1f deg%s: estimate_extrinsic: 1 refines it",
                    ToDegrees(fit.amount), kBy);
    case Cause::kGyro:
      return Format(
          "scale or axes of the gyro are wrong by up to %.1f %%%s: calibrate the IMU and set "
          "gyr_correction, and acc_correction as well",
          100 * fit.amount, kBy);
    default:
      return "";
  }
}

}  // namespace

RotationCheck::RotationCheck(const SensorConfig& sensor, int camera, double point_noise_px)
    : sensor_(sensor),
      camera_(camera),
      noise_(point_noise_px /
             CameraModel::Create(sensor.cameras[camera].parameters)->FocalLength()) {}

void RotationCheck::Add(const FrameMeasurement& measurement, bool in_doubt) {
  if (!frames_.empty() && LeaveGap(measurement.imu)) frames_.clear();
  frames_.push_back(measurement);
  frames_.back().lines.reset();
  while (ToSeconds(measurement.t_ns - frames_.front().t_ns) > kHistory) frames_.pop_front();
  if (!Observes(measurement.points, camera_)) return;
  const double stride = (in_doubt ? kStrideInDoubt : kStride) - 1e-3;
  if (measured_ns_ && ToSeconds(measurement.t_ns - *measured_ns_) < stride) return;
  measured_ns_ = measurement.t_ns;
  std::string reason;
  const auto pair = MeasureRotationPair(frames_, camera_, sensor_.imu_noise, noise_, &reason);
  if (!pair) return;
  pairs_.push_back(*pair);
  if (pairs_.size() > kMaxPairs) pairs_.erase(pairs_.begin());
  const bool is_known =
      sensor_.estimate_extrinsic != SensorConfig::ExtrinsicMode::kCalibrateRotation;
  if (++measured_ % kJudgedPairs == 0 && is_known) Judge(sensor_.cameras[camera_].T_B_C.rotation);
}

void RotationCheck::Judge(const Eigen::Quaterniond& R_B_C) {
  std::string reason;
  const auto calibrated = CalibrateExtrinsicRotation(pairs_, ExtrinsicRotationOptions(), &reason);
  const double error = calibrated ? calibrated->angularDistance(R_B_C) : 0;
  if (error > kMaxExtrinsicsError) {
    agrees_ = false;
    finding_ = Format(
        "extrinsicRotation is wrong by %.0f deg%s: is it the inverse, or of an image that is "
        "turned? estimate_extrinsic: 2 finds the right one",
        ToDegrees(error), kBy);
    return;
  }
  const RotationFit fit = ExplainRotations(pairs_, R_B_C);
  agrees_ = fit.cause == Cause::kNone;
  finding_ = IsRefined(fit) ? "" : Describe(fit);
}

// Returns whether the estimator refines what is wrong.
bool RotationCheck::IsRefined(const RotationFit& fit) const {
  constexpr double kSigmas = 3;
  switch (fit.cause) {
    case Cause::kTimeOffset:
      return sensor_.estimate_td;
    case Cause::kFocalLength:
      return sensor_.estimate_intrinsics &&
             std::abs(fit.amount) < kSigmas * sensor_.intrinsics_deviation.focal_length;
    case Cause::kExtrinsics:
      return sensor_.estimate_extrinsic == SensorConfig::ExtrinsicMode::kRefine;
    default:
      return false;
  }
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/rotation_check.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/camera/camera_model.h"
#include "common/format.h"
#include "common/geometry/so3.h"
#include "common/imu/imu_samples.h"
#include "vins_estimator/rotation_calibration/gross_errors.h"
#include "vins_estimator/rotation_calibration/rotation_pair.h"

namespace plm_vins {
namespace {

using Cause = RotationFit::Cause;

constexpr double kHistory = 0.5;                       // more than the interval of a pair [s]
constexpr double kStride = 0.3, kStrideInDoubt = 0.1;  // between pairs [s]
constexpr size_t kMaxPairs = 200;
constexpr int64_t kFirstPairs = 40;             // of a further camera, before it is known
constexpr int64_t kJudgedPairs = 10;            // between judgements
constexpr double kMaxExtrinsicsError = 0.17;    // [rad]; larger errors are not linear
constexpr double kLeastExtrinsicsError = 0.02;  // [rad]; smaller errors are usual
constexpr double kSigmas = 3;  // by which the least error that matters exceeds usual ones
constexpr char kBy[] = ", by the rotations of camera and gyro";

std::string Describe(const RotationFit& fit, double focal_length) {
  switch (fit.cause) {
    case Cause::kTimeOffset:
      return Format("td is wrong by %+.0f ms%s: add this to td, or estimate_td: 1",
                    1e3 * fit.amount, kBy);
    case Cause::kFocalLength:
      return Format(
          "the focal length is wrong by about %+.0f %%%s: calibrate the camera at this resolution, "
          "or estimate_intrinsics: 1 with a focal_length_deviation as large",
          100 * fit.amount, kBy);
    case Cause::kDistortion:
      return Format(
          "the distortion parameters are wrong by about %+.0f %% at the edge of the image%s: "
          "calibrate the camera",
          100 * fit.amount, kBy);
    case Cause::kPrincipalPoint:
      return Format(
          "the principal point is wrong by about %.0f px%s: calibrate the camera at this "
          "resolution and crop, or estimate_intrinsics: 1 with a principal_point_deviation as "
          "large",
          fit.amount * focal_length, kBy);
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

std::string DescribeMounting(const std::optional<MountingError>& error) {
  if (!error) {
    return "is it the inverse, or of an image that is turned? estimate_extrinsic: 2 finds the "
           "right one";
  }
  if (error->kind == MountingError::Kind::kInverse) {
    return "its inverse fits; give the camera in the IMU frame (T_imu_cam), not the IMU in the "
           "camera frame (T_cam_imu)";
  }
  if (error->kind == MountingError::Kind::kMirrored) {
    return "the image is mirrored, so flip it in the driver; or the camera's axes are not x right, "
           "y down and z forward";
  }
  return Format(
      "the image is turned by %.0f deg about the optical axis%s; turn it in the driver, or "
      "find the right rotation with estimate_extrinsic: 2",
      ToDegrees(error->angle), error->angle > 3 ? ", as by a camera upside down" : "");
}

std::string DescribeGyro(const std::string& topic, const std::string& error) {
  return "imu_topic " + topic + ": of the gyro, " + error + kBy +
         ": the driver must give right-handed rates in the axes of the accelerometer";
}

}  // namespace

RotationCheck::RotationCheck(const SensorConfig& sensor, int camera, double point_noise_px)
    : sensor_(sensor),
      camera_(camera),
      focal_length_(CameraModel::Create(sensor.cameras[camera].parameters)->FocalLength()),
      noise_(point_noise_px / focal_length_),
      lag_(sensor.cameras[camera].T_B_C.rotation) {}

void RotationCheck::Add(const FrameMeasurement& measurement, bool in_doubt) {
  if (!frames_.empty() && LeaveGap(measurement.imu)) {
    frames_.clear();
    lag_.Clear();
  }
  lag_.AddImu(measurement.imu);
  frames_.push_back(measurement);
  frames_.back().lines.reset();
  while (ToSeconds(measurement.t_ns - frames_.front().t_ns) > kHistory) frames_.pop_front();
  if (!Observes(measurement.points, camera_)) return;
  // A further camera may be wrong without doubt about the estimate, which the others determine.
  const bool is_unknown = camera_ > 0 && measured_ < kFirstPairs;
  const double stride = (in_doubt || is_unknown ? kStrideInDoubt : kStride) - 1e-3;
  if (measured_ns_ && ToSeconds(measurement.t_ns - *measured_ns_) < stride) return;
  measured_ns_ = measurement.t_ns;
  std::string reason;
  const auto pair = MeasureRotationPair(frames_, camera_, sensor_.imu_noise, noise_, &reason);
  if (!pair) return;
  const int64_t now_ns = measurement.imu.back().t_ns;
  lag_.AddRotation(now_ns - ToNanoseconds(pair->duration), now_ns, pair->R_then_now,
                   pair->deviation);
  pairs_.push_back(*pair);
  if (pairs_.size() > kMaxPairs) pairs_.erase(pairs_.begin());
  const bool is_known =
      sensor_.estimate_extrinsic != SensorConfig::ExtrinsicMode::kCalibrateRotation;
  if (++measured_ % kJudgedPairs == 0 && is_known) Judge(sensor_.cameras[camera_].T_B_C.rotation);
}

// Returns whether the timestamps are off by more than a linear fit finds.
bool RotationCheck::FindLag() {
  const std::optional<double> lag = lag_.lag();
  if (!lag) return false;
  finding_.text =
      camera_ == 0 ? Format("td is wrong by about %+.0f ms%s: add this to td, or correct the clock",
                            1e3 * *lag, kBy)
                   : Format("timestamps of camera %d are wrong by about %+.0f ms%s: correct them",
                            camera_, -1e3 * *lag, kBy);
  finding_.sigmas = kSigmas * std::abs(*lag) / LeastAmount(Cause::kTimeOffset);
  return true;
}

bool RotationCheck::FindGrossError(const Eigen::Quaterniond& R_B_C) {
  const auto mounting = ExplainByMounting(pairs_, R_B_C);
  if (mounting) mounting_ = mounting;
  std::string reason;
  ExtrinsicRotationOptions options;
  options.max_deviation = kMaxExtrinsicsError / kSigmas;
  const auto calibrated = CalibrateExtrinsicRotation(pairs_, options, &reason);
  const double error = calibrated ? calibrated->angularDistance(R_B_C)
                       : mounting ? std::abs(mounting->angle)
                                  : 0;
  if (error < kMaxExtrinsicsError) return false;
  const std::string key = camera_ == 0 ? "extrinsicRotation" : TransformKey(camera_);
  const bool is_gyro = mounting_ && mounting_->kind == MountingError::Kind::kGyro;
  finding_ = {is_gyro ? DescribeGyro(sensor_.imu_topic, mounting_->gyro)
                      : Format("%s is wrong by %.0f deg%s: ", key.c_str(), ToDegrees(error), kBy) +
                            DescribeMounting(mounting_),
              kSigmas * error / kLeastExtrinsicsError};
  error_ = std::min(error, 1.0);
  mounting_was_wrong_ = true;
  return true;
}

RotationFit RotationCheck::Explain(const Eigen::Quaterniond& R_B_C) const {
  const RotationFit fit = ExplainRotations(pairs_, R_B_C, noise_);
  // An error of the gyro shows in the first camera, too, whose check names it.
  return camera_ > 0 && fit.cause == Cause::kGyro ? RotationFit{} : fit;
}

void RotationCheck::Judge(const Eigen::Quaterniond& R_B_C) {
  agrees_ = false;
  error_ = 0;
  if (FindLag()) return;
  const RotationFit fit = Explain(R_B_C);
  const bool is_gross = fit.cause == Cause::kExtrinsics && fit.amount > kMaxExtrinsicsError;
  if ((fit.cause == Cause::kUnknown || is_gross) && FindGrossError(R_B_C)) return;
  agrees_ = fit.cause == Cause::kNone;
  // A gross error lasts while the rotations tell too little.
  if (fit.cause == Cause::kUnknown && mounting_was_wrong_) return;
  mounting_was_wrong_ = false;
  mounting_.reset();
  finding_ = {};
  if (!IsRefined(fit)) {
    const std::string text = Describe(fit, focal_length_);
    const bool is_of_further = camera_ > 0 && !text.empty();
    finding_ = {is_of_further ? Format("camera %d: ", camera_) + text : text,
                kSigmas * std::abs(fit.amount) / LeastAmount(fit.cause)};
    if (fit.cause != Cause::kTimeOffset) error_ = std::abs(fit.amount);
  }
}

// Returns whether the estimator refines what is wrong.
bool RotationCheck::IsRefined(const RotationFit& fit) const {
  const IntrinsicsDeviation& prior = sensor_.intrinsics_deviation;
  const auto is_within = [this](double error, double deviation) {
    return sensor_.estimate_intrinsics && std::abs(error) < kSigmas * deviation;
  };
  switch (fit.cause) {
    case Cause::kTimeOffset:
      return sensor_.estimate_td;
    case Cause::kFocalLength:
      return is_within(fit.amount, prior.focal_length);
    case Cause::kDistortion:
      return is_within(fit.amount, prior.distortion);
    case Cause::kPrincipalPoint:
      return is_within(fit.amount * focal_length_, prior.principal_point);
    case Cause::kExtrinsics:
      return sensor_.estimate_extrinsic == SensorConfig::ExtrinsicMode::kRefine;
    default:
      return false;
  }
}

}  // namespace plm_vins

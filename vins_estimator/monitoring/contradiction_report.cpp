// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/contradiction_report.h"

#include <cmath>

#include "common/format.h"

namespace plm_vins {
namespace {

constexpr double kRateTolerance = 0.2;  // relative to the configured rate
constexpr double kMaxJitter = 1e-3;     // [s]; at 1 rad/s this moves a corner by half a pixel
constexpr double kNoisier = 1.5;
constexpr double kFarTooNoisy = 8;  // vibration on vehicles reaches five

constexpr char kChecks[] =
    "; check, the most likely first: extrinsicRotation (axes, or inverted), td, focal length and "
    "distortion, scale and axes of the IMU, moving objects, parts of the image that never move";
constexpr char kChecksOfTranslation[] =
    "; camera and gyro agree about rotations, so extrinsicRotation, td and the focal length are "
    "right; check, the most likely first: scale and axes of the accelerometer (acc_correction), "
    "moving objects, extrinsicTranslation, parts of the image that never move";

}  // namespace

std::string DescribeContradiction(const ContradictionEvidence& evidence) {
  std::string text = "the camera contradicts the IMU";
  if (evidence.noise_factor > kNoisier) {
    text += Format(", whose noise is raised by a factor of %.0f", evidence.noise_factor);
  }
  if (std::abs(evidence.imu_rate / evidence.configured_imu_rate - 1) > kRateTolerance) {
    text += Format("; the IMU rate is %.0f Hz, but imu_rate is %.0f", evidence.imu_rate,
                   evidence.configured_imu_rate);
  }
  if (evidence.imu_jitter > kMaxJitter) {
    text += Format("; IMU timestamps jitter by %.1f ms", 1e3 * evidence.imu_jitter);
  }
  if (evidence.image_jitter > kMaxJitter) {
    text += Format("; image timestamps jitter by %.1f ms", 1e3 * evidence.image_jitter);
  }
  if (evidence.accel_noise_factor > kFarTooNoisy) {
    text += Format("; acc_n is %.0f times too small for these samples (noise or vibration)",
                   evidence.accel_noise_factor);
  }
  if (evidence.gyro_noise_factor > kFarTooNoisy) {
    text += Format("; gyr_n is %.0f times too small for these samples (noise or vibration)",
                   evidence.gyro_noise_factor);
  }
  using Rotations = ContradictionEvidence::Rotations;
  if (evidence.rotations == Rotations::kExplained) return text;
  return text + (evidence.rotations == Rotations::kAgree ? kChecksOfTranslation : kChecks);
}

}  // namespace plm_vins

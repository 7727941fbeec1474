// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/fault_report.h"

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
    "distortion, scale and axes of the IMU, moving objects, parts of the image that never move, "
    "electronic image stabilization (switch it off)";
constexpr char kChecksOfTranslation[] =
    "; camera and gyro agree about rotations, so extrinsicRotation, td and the focal length are "
    "right; check, the most likely first: scale, axes and signs of the accelerometer "
    "(acc_correction), its delay after the gyro, moving objects, extrinsicTranslation, parts of "
    "the "
    "image that never move, electronic image stabilization (switch it off)";

void Add(const std::string& fault, std::string* text) {
  if (!text->empty()) *text += "; ";
  *text += fault;
}

void Add(const CameraFaults& faults, std::string* text) {
  const std::string camera = Format("camera %d: ", faults.camera);
  if (const auto& misfit_px = faults.misfit_px) {
    Add(camera +
            Format("it deviates by %.1f px from its calibration and is not used; recalibrate it",
                   *misfit_px),
        text);
  }
  if (const auto& delay = faults.delay) {
    Add(camera + Format("it exposes %+.0f ms after camera 0", 1e3 * *delay), text);
  }
  if (const auto& baseline = faults.baseline; baseline && baseline->IsSignificant()) {
    Add(camera + Format("according to the IMU, its baseline is %.1f +- %.1f %% %s than configured",
                        100 * std::abs(baseline->error), 100 * baseline->deviation,
                        baseline->error > 0 ? "longer" : "shorter"),
        text);
  }
}

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

std::string DescribeFaults(const std::vector<CameraFaults>& cameras, const DepthFaults& depth) {
  std::string text;
  for (const CameraFaults& camera : cameras) Add(camera, &text);
  if (const auto& scale = depth.scale; scale && scale->IsSignificant()) {
    Add(Format("depth_topic: according to the IMU, depths are %.1f +- %.1f %% too %s",
               100 * std::abs(scale->error), 100 * scale->deviation,
               scale->error > 0 ? "long" : "short"),
        &text);
  }
  if (const auto& delay = depth.delay) {
    Add(Format("depth_topic: depth images are %.0f ms %s than their timestamps, or not aligned to "
               "camera 0",
               1e3 * std::abs(*delay), *delay > 0 ? "older" : "newer"),
        &text);
  }
  return text;
}

}  // namespace plm_vins

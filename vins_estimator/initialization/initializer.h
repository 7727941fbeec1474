// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/measurements.h"
#include "vins_estimator/imu/standstill_detector.h"
#include "vins_estimator/initialization/extrinsic_calibrator.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// One image with its state. Its IMU samples lead from the *previous* InitialFrame to it (both
// images' times included), as if the images between had never been; those of the first one lead
// from the image before it.
struct InitialFrame {
  FrameMeasurement measurement;
  FrameState state;
};

struct InitializationResult {
  std::vector<InitialFrame> frames;  // oldest first, the last one is the newest image
  bool from_standstill = false;
  Rigid3d T_B_C;  // as calibrated before or as configured
};

// Finds the first states of the estimator: from standstill as soon as the body has stood still for
// three quarters of a second, else from motion as soon as 1.5 s of images or more determine
// gravity, velocity and scale. World: z up, origin and heading 0 at the first frame of the result.
// Where the camera's rotation is to be calibrated, this comes first, and takes turns about at least
// two axes. Waits rather than guesses, and says why. Keeps at most three seconds of images. Its
// result is deterministic.
class Initializer {
 public:
  explicit Initializer(const Config& config);

  // Takes over the camera's rotation where `other` has calibrated it, instead of doing so anew.
  void KeepRotation(const Initializer& other);

  // Takes the next image, one that CheckMeasurement() does not refuse after the one before. Returns
  // at most window_size + 1 frames as soon as their states can be determined.
  std::optional<InitializationResult> Add(const FrameMeasurement& measurement);

  // The first image that a result would go back to; nothing before there is an image.
  std::optional<int64_t> begin_ns() const;

  // Why there is no result yet, e.g. "too little parallax: 4.2 px of 15.0 px".
  const std::string& reason() const { return reason_; }

 private:
  void StartOver(const std::string& reason);
  void Append(const FrameMeasurement& measurement);
  void CalibrateRotation();
  std::optional<InitializationResult> TryStandstill();
  std::optional<InitializationResult> TryMotion();

  SensorConfig sensor_;  // with the rotation of the camera as calibrated
  double point_noise_px_;
  size_t max_frames_;
  StandstillDetector standstill_;
  std::optional<ExtrinsicCalibrator> calibrator_;  // until the rotation is known
  std::deque<FrameMeasurement> buffer_;            // without gap in IMU samples and tracks
  std::optional<int64_t> start_ns_;                // of the first image since the reset
  std::optional<int64_t> last_attempt_ns_;         // to initialise from motion
  std::string reason_ = "waiting for images";
};

}  // namespace plm_vins

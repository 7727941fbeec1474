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
#include "vins_estimator/rotation_calibration/extrinsic_calibrator.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// An image with its state. Its IMU samples are those from the *previous* InitialFrame up to it
// (including both ends), as if there were no images in between; those of the first one are from the
// image before it.
struct InitialFrame {
  FrameMeasurement measurement;
  FrameState state;
};

struct InitializationResult {
  std::vector<InitialFrame> frames;  // oldest first, the last one is the newest image
  bool from_standstill = false;
  std::vector<Rigid3d> T_B_C;  // by camera, calibrated or configured
  double accel_bias = 0;  // lower bound on its size, from the norm of gravity at standstill [m/s^2]
};

// Initializes the estimator: from standstill once the body has stood still for 0.75 s, or for half
// a second if the IMU shows its noise alone; otherwise from motion once at least 0.75 s of images
// make gravity, velocity and scale observable. A scale that is uncertain by 10 % is enough: the
// window is optimized as a whole until it is full, and its covariance states the uncertainty. With
// overlapping cameras or measured depth, 0.25 s of standstill or 0.3 s of motion suffice. World: z
// up, origin and zero heading at the first frame of the result. If the camera's rotation has to be
// calibrated, this comes first and requires rotations about at least two axes. While waiting,
// reason() states why. Stores at most three seconds of images. Its result is deterministic.
class Initializer {
 public:
  explicit Initializer(const Config& config);

  // Adopts the camera's rotation from `other` if that has calibrated it.
  void KeepRotation(const Initializer& other);

  // Adds the next image, which must satisfy CheckMeasurement(). Returns at most window_size + 1
  // frames as soon as their states are observable.
  std::optional<InitializationResult> Add(const FrameMeasurement& measurement);

  // Returns the time of the first image that a result could contain; nullopt if there is none.
  std::optional<int64_t> begin_ns() const;

  // States why there is no result yet, e.g. "too little parallax: 4.2 px of 15.0 px".
  const std::string& reason() const { return reason_; }

 private:
  void StartOver(const std::string& reason);
  // Returns whether the image has too few points to be used; its IMU samples are then added to
  // those of the next image.
  bool Skip(const FrameMeasurement& measurement);
  void Append(const FrameMeasurement& measurement);
  void CalibrateRotation();
  void SetRotation(const Eigen::Quaterniond& R_B_C);
  std::vector<Rigid3d> Extrinsics() const;
  std::optional<InitializationResult> TryStandstill(int64_t since_ns);
  std::optional<InitializationResult> TryMotion();
  bool MayTryMotion(bool stereo);

  SensorConfig sensor_;  // with the calibrated rotation of the camera
  double point_noise_px_;
  bool has_depth_;  // overlapping cameras or depth images
  size_t max_frames_;
  StandstillDetector standstill_;
  StandstillDetector quiet_standstill_;
  std::optional<ExtrinsicCalibrator> calibrator_;  // until the rotation is known
  std::deque<FrameMeasurement> buffer_;            // contiguous in IMU samples and tracks
  std::vector<ImuSample> skipped_imu_;             // since the newest image in the buffer
  std::optional<int64_t> last_attempt_ns_;         // last attempt to initialize from motion
  std::string reason_ = "waiting for images";
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/imu/confirmed_standstill.h"
#include "vins_estimator/imu/imu_stillness.h"
#include "vins_estimator/imu/unseen_motion.h"

namespace plm_vins {

// Detects standstill from the last half second of IMU samples and tracked corners: the IMU is still
// (ImuStillness), and the median corner is where it was at the start of the window. Both are
// required: smooth flight resembles standstill for the IMU, a distant scene for the camera.
//
// A standstill that both confirmed continues while images show too little (blank, covered), as long
// as the IMU readings equal those of the standstill (ConfirmedStandstill). It also continues if the
// corners move faster than the body could without the IMU measuring it: then the scene moves (a
// train, the deck of a ship). And it continues if the corners rest while the IMU feels a motion
// that the camera would see: then the view moves along (a lift, a vehicle).
//
// The common motion of the corners is a more sensitive measure than their distances, to which noise
// contributes.
class StandstillDetector {
 public:
  struct Options {
    ImuStillness::Options imu;
    double max_motion_px = 1.0;  // median corner motion over the window [px]
    int min_points = 10;         // corners that must be tracked through the window
    double max_doubt = 2.0;      // after a standstill, if the IMU shows more than its noise [s]
  };

  struct Standstill {
    int64_t since_ns = 0;           // time of an image since which the body has stood still
    double common_px = 0;           // common motion of the corners since that image [px]
    bool scene_moves = false;       // the image shows motion that the IMU does not feel
    bool view_moves_along = false;  // the IMU feels motion that the image does not show
  };

  StandstillDetector(const ImuNoise& noise, const Options& options);
  explicit StandstillDetector(const ImuNoise& noise) : StandstillDetector(noise, Options()) {}

  // Adds the next image with the IMU samples since the previous one, and the depth of the scene [m]
  // if known. Returns nullopt if the body moved within the window, and until the window is full.
  std::optional<Standstill> Add(const FrameMeasurement& measurement,
                                std::optional<double> depth = std::nullopt);

  // Returns whether the newest image shows motion that the IMU does not (yet) measure. While the
  // depth is unknown, a slow start close to the ground looks like a moving scene, and a tiny scale
  // would explain any motion of the scene. Until the IMU decides, dead reckoning can replace the
  // camera: biases are known after a standstill.
  bool doubts_camera() const { return doubts_camera_; }

  // Returns whether the corners move while the IMU shows its noise alone.
  bool sees_unfelt_motion() const { return sees_unfelt_motion_; }

  void Reset();

 private:
  // Returns whether the corners move too fast for a body whose IMU shows standstill.
  bool IsOfScene(double motion, std::optional<double> depth) const;
  // Returns whether the corners move by less than what the IMU feels would move them, even if their
  // common motion, as a ray, is by so much greater.
  bool IsUnseen(double greatest_motion, std::optional<double> depth) const;

  Options options_;
  ImuStillness imu_;
  ConfirmedStandstill confirmed_;
  UnseenMotion unseen_;
  // Content of the images since the confirmed standstill.
  enum class Seen { kStandstill, kMotion, kMovingScene };
  Seen seen_ = Seen::kStandstill;
  int64_t confirmed_ns_ = 0;  // the newest image that confirmed the standstill
  bool doubts_camera_ = false, sees_unfelt_motion_ = false;
  std::deque<PointFrame> points_;               // points of the images in the window
  std::deque<Eigen::Vector3d> felt_positions_;  // at the same images
};

}  // namespace plm_vins

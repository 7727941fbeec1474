// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

constexpr int kFewFeatures = 6;  // fewer points and lines do not fix a pose

// Bounds beyond which an estimate cannot be right for a robot with a working IMU.
struct FailureLimits {
  double accel_bias = 3.0;     // [m/s^2]
  double gyro_bias = 0.5;      // [rad/s]
  double velocity = 50.0;      // [m/s]
  double velocity_jump = 3.0;  // correction of the velocity by one image [m/s]
  double position_jump = 2.0;  // correction of the position by one image [m]
  double rotation_jump = 0.7;  // correction of the rotation by one image [rad]
  double time_offset = 0.2;    // between td as estimated and as configured [s]
};

// Why the newest state, optimised, cannot be believed, given what the IMU predicted; nothing where
// it can be believed.
std::optional<std::string> DetectFailure(const FailureLimits& limits, const FrameState& predicted,
                                         const FrameState& optimized);

// Why a time offset that was estimated cannot be believed, by how far it is from the configured
// one [s]; nothing where it can.
std::optional<std::string> DetectRunaway(const FailureLimits& limits, double time_offset_change);

// Notices when the camera goes on contradicting the state: image after image, a large share of the
// landmarks that it shows does not fit. A single bad IMU sample can do that, and no other limit
// need see it. An image that shows too few to say so neither goes on with that nor ends it.
class ContradictionMonitor {
 public:
  // Takes how many landmarks an image shows, points and lines, and how many of them did not fit
  // after the optimisation. The reason once the contradiction has lasted too long; nothing before.
  std::optional<std::string> Add(int64_t t_ns, int landmarks, int rejected);

  bool contradicts() const { return contradicts_; }  // so far as images tell

 private:
  bool contradicts_ = false;
  int64_t newest_ns_ = 0;         // stamp of the last image
  int64_t contradiction_ns_ = 0;  // how long
};

}  // namespace plm_vins

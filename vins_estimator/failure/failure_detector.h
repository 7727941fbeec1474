// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

constexpr int kFewFeatures = 6;  // fewer points and lines do not constrain a pose

// Bounds outside of which the estimate of a robot with a working IMU is implausible.
struct FailureLimits {
  double accel_bias = 3.0;     // [m/s^2]
  double gyro_bias = 0.5;      // [rad/s]
  double velocity = 50.0;      // [m/s]
  double velocity_jump = 3.0;  // correction of the velocity by one image [m/s]
  double position_jump = 2.0;  // correction of the position by one image [m]
  double rotation_jump = 0.7;  // correction of the rotation by one image [rad]
  double time_offset = 0.2;    // between estimated and configured td [s]
};

// Returns the reason if the optimized newest state is implausible, given its prediction by the IMU;
// nullopt if it is plausible.
std::optional<std::string> DetectFailure(const FailureLimits& limits, const FrameState& predicted,
                                         const FrameState& optimized);

// Returns the reason if the estimated time offset is implausible, given its difference from the
// configured one [s]; nullopt if it is plausible.
std::optional<std::string> DetectRunaway(const FailureLimits& limits, double time_offset_change);

// Detects that the camera contradicts the state for a while: in consecutive images, a large share
// of the observed landmarks are outliers. A single bad IMU sample can cause this without exceeding
// any other limit. Images with too few landmarks neither continue nor end a contradiction.
class ContradictionMonitor {
 public:
  // Adds the number of landmarks, points and lines, that an image observes, and how many of them
  // are outliers after the optimization. Returns the reason once the contradiction has lasted too
  // long, otherwise nullopt.
  std::optional<std::string> Add(int64_t t_ns, int landmarks, int rejected);

  bool contradicts() const { return contradicts_; }  // according to the images so far

 private:
  bool contradicts_ = false;
  int64_t newest_ns_ = 0;         // time of the last image
  int64_t contradiction_ns_ = 0;  // duration of the contradiction
};

}  // namespace plm_vins

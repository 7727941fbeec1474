// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "common/geometry/rigid3.h"
#include "simulator/quintic_spline.h"

namespace plm_vins::simulator {

// Exact motion of the body at one time.
struct BodyState {
  Rigid3d T_W_B;
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();     // [m/s]
  Eigen::Vector3d a_W = Eigen::Vector3d::Zero();     // [m/s^2], without gravity
  Eigen::Vector3d gyro_B = Eigen::Vector3d::Zero();  // angular velocity in B [rad/s]
};

enum class Motion {
  kGentle,        // average 0.7 m/s and 0.25 rad/s, all axes
  kFast,          // average 1.3 m/s and 0.5 rad/s, peaks of 3 m/s and 1.2 rad/s
  kHover,         // position constant to a few centimeters, after the lead-in
  kPureRotation,  // rotation of B about its origin, after the lead-in
  kCorridor,      // straight along x with a little sway
  kStill          // constant pose
};

struct TrajectoryOptions {
  Motion motion = Motion::kGentle;
  double duration = 60.0;  // [s]
  double rest = 1.0;       // standstill at the start [s]
  double lead_in = 8.0;    // gentle flight between standstill and hover or pure rotation [s]
  Eigen::Vector3d center{0, 0, 1.5};    // center of the box that B never leaves [m]
  Eigen::Vector3d extent{2, 1.5, 0.6};  // half the size of that box [m]
  // Attitude of B in the vehicle frame V (x forward, y left, z up).
  Eigen::Quaterniond R_V_B = Eigen::Quaterniond::Identity();
  uint64_t seed = 1;
};

// A smooth flight with exact derivatives: a quintic B-spline through random control points of the
// position and of the vehicle's yaw, pitch and roll. Immutable.
class Trajectory {
 public:
  explicit Trajectory(const TrajectoryOptions& options);

  double duration() const { return duration_; }  // [s]

  // State at `t` seconds after the start; `t` is clamped to [0, duration()].
  BodyState At(double t) const;

 private:
  double duration_;
  Eigen::Quaterniond R_V_B_;
  QuinticSpline<6> spline_;  // x, y, z, roll, pitch, yaw of V
};

// Returns R_V_B of a body whose camera looks forward, horizontally and upright.
Eigen::Quaterniond ForwardLookingBody(const Rigid3d& T_B_C);

}  // namespace plm_vins::simulator

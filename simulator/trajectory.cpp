// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/trajectory.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulator/random.h"

namespace plm_vins::simulator {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using Control = QuinticSpline<6>::Vector;

// Parameters of the random control points for one kind of motion.
struct MotionProfile {
  Vector3d sway;     // amplitude about the anchor [m], limited by the extent
  double patrol;     // speed of the anchor in the space that the sway leaves [m/s]
  Vector3d tilt;     // amplitude of roll, pitch and yaw [rad]
  double yaw_rate;   // constant rate of rotation [rad/s]
  bool holds_place;  // anchored at the end of the lead-in instead of the center
};

MotionProfile ProfileOf(Motion motion) {
  switch (motion) {
    case Motion::kGentle:
      return {{2.0, 1.5, 0.6}, 0.5, {0.3, 0.3, 0.4}, 0.15, false};
    case Motion::kFast:
      return {{2.2, 1.8, 0.8}, 1.0, {0.4, 0.4, 0.6}, 0.3, false};
    case Motion::kHover:
      return {{0.04, 0.04, 0.04}, 0.0, {0.04, 0.04, 0.06}, 0.0, true};
    case Motion::kPureRotation:
      return {Vector3d::Zero(), 0.0, {0.25, 0.3, 0.8}, 0.15, true};
    case Motion::kCorridor:
      return {{0.1, 0.35, 0.3}, 0.0, {0.08, 0.08, 0.12}, 0.0, false};
    default:
      return {Vector3d::Zero(), 0.0, Vector3d::Zero(), 0.0, true};
  }
}

bool HasLeadIn(Motion motion) {
  return motion == Motion::kHover || motion == Motion::kPureRotation;
}

// Generates the control points in sequence.
class ControlGenerator {
 public:
  explicit ControlGenerator(const TrajectoryOptions& options)
      : options_(options), random_(options.seed), anchor_(options.center) {}

  std::vector<Control> Generate() {
    const double spacing = KnotSpacing(options_.motion);
    const int count = static_cast<int>(std::ceil(options_.duration / spacing)) + 5;
    // A segment is stationary if all six control points that it depends on are equal.
    const int resting = static_cast<int>(std::ceil(options_.rest / spacing)) + 5;
    std::vector<Control> controls{First()};
    for (int i = 1; i < count; ++i) {
      const double t = (i - 2.5) * spacing;  // half a knot before the control's largest weight
      controls.push_back(i < resting ? controls.front() : Next(t, spacing, controls.back()));
    }
    return controls;
  }

  static double KnotSpacing(Motion motion) { return motion == Motion::kFast ? 0.6 : 1.0; }

 private:
  Control First() {
    Control control = Control::Zero();
    control.head<3>() = anchor_;
    if (options_.motion == Motion::kCorridor) control.x() -= options_.extent.x();
    return control;
  }

  Control Next(double t, double spacing, const Control& previous) {
    const bool leading_in = HasLeadIn(options_.motion) && t < options_.rest + options_.lead_in;
    const MotionProfile profile = ProfileOf(leading_in ? Motion::kGentle : options_.motion);
    if (!profile.holds_place) {
      anchor_ = options_.center + Patrol(profile, t);
    } else if (was_leading_in_) {
      anchor_ = previous.head<3>();
    }
    was_leading_in_ = leading_in;
    yaw_ += profile.yaw_rate * spacing;

    Control control;
    control.head<3>() =
        anchor_ + random_.UniformInBox(profile.sway.cwiseMin(options_.extent)) + Progress(t);
    control.tail<3>() = random_.UniformInBox(profile.tilt) + Vector3d(0, 0, yaw_);
    control.head<3>() = control.head<3>()
                            .cwiseMax(options_.center - options_.extent)
                            .cwiseMin(options_.center + options_.extent);
    return control;
  }

  // Oscillation of the anchor through the space that the sway leaves, with a different period for
  // each axis.
  Vector3d Patrol(const MotionProfile& profile, double t) const {
    const Vector3d amplitude = (options_.extent - profile.sway).cwiseMax(0.0);
    Vector3d offset = Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      if (amplitude[axis] == 0.0) continue;
      offset[axis] = amplitude[axis] * std::sin(profile.patrol * t / amplitude[axis]);
    }
    return offset;
  }

  // Position along the corridor at time t, relative to its middle.
  Vector3d Progress(double t) const {
    if (options_.motion != Motion::kCorridor) return Vector3d::Zero();
    const double share = (t - options_.rest) / (options_.duration - options_.rest);
    return {options_.extent.x() * (2.0 * share - 1.0), 0, 0};
  }

  TrajectoryOptions options_;
  Random random_;
  Vector3d anchor_;
  double yaw_ = 0;
  bool was_leading_in_ = false;
};

}  // namespace

Trajectory::Trajectory(const TrajectoryOptions& options)
    : duration_(options.duration),
      R_V_B_(options.R_V_B),
      spline_(ControlGenerator::KnotSpacing(options.motion), ControlGenerator(options).Generate()) {
}

BodyState Trajectory::At(double t) const {
  const auto value = spline_.At(std::clamp(t, 0.0, duration_));
  const double roll = value.position[3], pitch = value.position[4], yaw = value.position[5];
  const Vector3d rates = value.velocity.tail<3>();
  const Eigen::Quaterniond R_W_V(AngleAxisd(yaw, Vector3d::UnitZ()) *
                                 AngleAxisd(pitch, Vector3d::UnitY()) *
                                 AngleAxisd(roll, Vector3d::UnitX()));
  // Converts Euler angle rates to angular velocity.
  const double sr = std::sin(roll), cr = std::cos(roll);
  const double sp = std::sin(pitch), cp = std::cos(pitch);
  const Vector3d rate_V(rates[0] - sp * rates[2], cr * rates[1] + sr * cp * rates[2],
                        -sr * rates[1] + cr * cp * rates[2]);
  BodyState state;
  state.T_W_B = {(R_W_V * R_V_B_).normalized(), value.position.head<3>()};
  state.v_W = value.velocity.head<3>();
  state.a_W = value.acceleration.head<3>();
  state.gyro_B = R_V_B_.conjugate() * rate_V;
  return state;
}

Eigen::Quaterniond ForwardLookingBody(const Rigid3d& T_B_C) {
  Eigen::Matrix3d R_V_C;
  R_V_C << 0, 0, 1,  //
      -1, 0, 0,      //
      0, -1, 0;
  return (Eigen::Quaterniond(R_V_C) * T_B_C.rotation.conjugate()).normalized();
}

}  // namespace plm_vins::simulator

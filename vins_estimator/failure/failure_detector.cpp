// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/failure/failure_detector.h"

#include <algorithm>
#include <cmath>

#include "common/format.h"
#include "common/measurements.h"
#include "vins_estimator/state/derived_covariance.h"

namespace plm_vins {
namespace {

// Bounds outside of which the estimate of a robot with a working IMU is implausible.
constexpr double kMaxAccelBias = 3.0;         // [m/s^2]
constexpr double kMaxGyroBias = 0.5;          // [rad/s]
constexpr double kMaxVelocity = 50.0;         // [m/s]
constexpr double kMaxVelocityJump = 3.0;      // correction of the velocity by one image [m/s]
constexpr double kMaxPositionJump = 2.0;      // correction of the position by one image [m]
constexpr double kMaxRotationJump = 0.7;      // correction of the rotation by one image [rad]
constexpr double kMaxTimeOffsetChange = 0.2;  // between estimated and configured td [s]

constexpr double kMaxRejectedShare = 0.25;  // a few percent in normal flight
constexpr int kMinRejected = 5;             // at first; outlier rejection leaves fewer later
constexpr double kMaxContradiction = 0.5;   // [s]
// Limits the contribution of one image, because a gap between images is no contradiction.
const int64_t kMaxInterval_ns = ToNanoseconds(kMaxContradiction / 2);

// Standard deviation that the pose may gain while blind [m]: even with an error of three sigma, it
// is good enough for a vehicle to stop.
constexpr double kMaxDeviation = 0.5;

bool IsFinite(const FrameState& state) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(state.pose.begin(), state.pose.end(), finite) &&
         std::all_of(state.motion.begin(), state.motion.end(), finite);
}

std::optional<std::string> Exceeds(const char* what, double value, double limit, const char* unit) {
  if (value <= limit) return std::nullopt;
  return Format("%s is %.2f %s, more than %.2f", what, value, unit, limit);
}

}  // namespace

std::optional<std::string> DetectFailure(const FrameState& predicted, const FrameState& optimized) {
  if (!IsFinite(optimized)) return "the optimization returned non-finite values";
  const double turn = predicted.rotation().angularDistance(optimized.rotation());
  const std::optional<std::string> causes[] = {
      Exceeds("accelerometer bias", optimized.accel_bias().norm(), kMaxAccelBias, "m/s^2"),
      Exceeds("gyro bias", optimized.gyro_bias().norm(), kMaxGyroBias, "rad/s"),
      Exceeds("velocity", optimized.velocity().norm(), kMaxVelocity, "m/s"),
      Exceeds("correction of velocity", (optimized.velocity() - predicted.velocity()).norm(),
              kMaxVelocityJump, "m/s"),
      Exceeds("correction of position", (optimized.position() - predicted.position()).norm(),
              kMaxPositionJump, "m"),
      Exceeds("correction of rotation", turn, kMaxRotationJump, "rad"),
  };
  for (const auto& cause : causes) {
    if (cause) return cause;
  }
  return std::nullopt;
}

std::optional<std::string> DetectRunaway(double time_offset_change) {
  if (!std::isfinite(time_offset_change)) return "td is not finite";
  return Exceeds("change of td", std::abs(time_offset_change), kMaxTimeOffsetChange, "s");
}

std::optional<std::string> ContradictionMonitor::Add(int64_t t_ns, int landmarks, int rejected) {
  const int64_t interval_ns = std::min(t_ns - newest_ns_, kMaxInterval_ns);
  newest_ns_ = t_ns;
  const bool fits = rejected == 0 || rejected < kMaxRejectedShare * landmarks;
  const bool by_chance = !contradicts_ && rejected < kMinRejected;
  if (fits && landmarks >= kFewFeatures) contradicts_ = false;
  if (fits || by_chance) return std::nullopt;
  contradiction_ns_ = contradicts_ ? contradiction_ns_ + interval_ns : 0;
  contradicts_ = true;
  const double seconds = ToSeconds(contradiction_ns_);
  if (seconds < kMaxContradiction) return std::nullopt;
  return Format("the camera contradicts the state: %d of %d landmarks rejected, for %.1f s",
                rejected, landmarks, seconds);
}

std::optional<std::string> BlindnessMonitor::Add(
    int features_seen, bool is_held, const FrameState& state,
    const std::optional<Eigen::Matrix<double, 6, 6>>& covariance) {
  blind_ = features_seen < kFewFeatures;
  if (!covariance) return std::nullopt;
  const Hold now{state.t_ns, state.position(), covariance->topLeftCorner<3, 3>().trace()};
  if (!hold_) hold_ = now;
  const double variance = PositionVarianceFrom(hold_->p_W, state, *covariance);
  const double added = std::sqrt(std::max(0.0, variance - hold_->variance));
  if (added <= kMaxDeviation) {
    if (is_held) hold_ = now;
    return std::nullopt;
  }
  return Format(
      "no feature has constrained the position for %.1f s; its standard deviation grew by %.2f m",
      ToSeconds(state.t_ns - hold_->t_ns), added);
}

}  // namespace plm_vins

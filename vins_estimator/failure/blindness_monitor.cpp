// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/failure/blindness_monitor.h"

#include <algorithm>
#include <cmath>

#include "common/format.h"
#include "common/measurements.h"
#include "vins_estimator/failure/failure_detector.h"
#include "vins_estimator/state/derived_covariance.h"

namespace plm_vins {
namespace {

// Standard deviation that the pose may gain while blind [m]: even with an error of three sigma, it
// is good enough for a vehicle to stop.
constexpr double kMaxDeviation = 0.5;

}  // namespace

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

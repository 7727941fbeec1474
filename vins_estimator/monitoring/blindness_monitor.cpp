// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/blindness_monitor.h"

#include <algorithm>
#include <cmath>

#include "common/format.h"
#include "common/measurements.h"
#include "vins_estimator/monitoring/failure_detector.h"

namespace plm_vins {
namespace {

// Standard deviation that blindness may add [m]: with errors of three of them, the pose is still
// good for a vehicle to stop by.
constexpr double kMaxDeviation = 0.5;

}  // namespace

std::optional<std::string> BlindnessMonitor::Add(int64_t t_ns, int features_seen,
                                                 int features_holding,
                                                 const Eigen::Matrix3d& position_covariance) {
  const double variance = position_covariance.trace();
  blind_ = features_seen < kFewFeatures;
  if (!(variance > 0)) return std::nullopt;
  const double added = held_ns_ ? std::sqrt(std::max(0.0, variance - variance_before_)) : 0;
  if (added <= kMaxDeviation) {
    if (features_holding >= kFewFeatures || !held_ns_) {
      held_ns_ = t_ns;
      variance_before_ = variance;
    }
    return std::nullopt;
  }
  return Format("nothing has held the position for %.1f s, which leaves it open by %.2f m",
                ToSeconds(t_ns - *held_ns_), added);
}

}  // namespace plm_vins

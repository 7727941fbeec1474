// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/estimate_monitor.h"

namespace plm_vins {

std::optional<Failure> EstimateMonitor::Add(const Evidence& evidence) {
  const EstimatorCounts& counts = evidence.counts;
  const FrameState& newest = evidence.newest;
  if (!evidence.solved) return Failure{"the optimization has no solution"};
  if (const auto contradiction =
          contradiction_monitor_.Add(newest.t_ns, counts.known_seen, counts.known_rejected)) {
    return Failure{*contradiction};
  }
  const bool is_held =
      evidence.stationary || counts.known_seen - counts.known_rejected >= kFewFeatures;
  if (const auto blindness = blindness_monitor_.Add(counts.points_observed + counts.lines_observed,
                                                    is_held, newest, evidence.pose_covariance)) {
    return Failure{*blindness, /*has_drifted=*/true};
  }
  if (const auto runaway = DetectRunaway(FailureLimits(), evidence.time_offset_change)) {
    return Failure{*runaway, /*has_drifted=*/true};
  }
  if (const auto jump = DetectFailure(FailureLimits(), evidence.predicted, newest)) {
    return Failure{*jump};
  }
  return std::nullopt;
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/failure/estimate_monitor.h"

#include "common/format.h"

namespace plm_vins {
namespace {

constexpr double kLongGap = 0.2;  // [s] without IMU samples; explains a failure after it

}  // namespace

std::optional<Failure> EstimateMonitor::Add(const Evidence& evidence) {
  std::optional<Failure> failure = Judge(evidence);
  const double gap = evidence.longest_imu_gap;
  if (failure && gap > kLongGap) {
    failure->why = Format("a gap of %.1f s in the IMU samples: ", gap) + failure->why;
  }
  return failure;
}

std::optional<Failure> EstimateMonitor::Judge(const Evidence& evidence) {
  const EstimatorCounts& counts = evidence.counts;
  const FrameState& newest = evidence.newest;
  if (!evidence.solved) return Failure{"the optimization has no solution"};
  if (const auto contradiction =
          contradiction_monitor_.Add(newest.t_ns, counts.known_seen, counts.known_rejected)) {
    return Failure{*contradiction};
  }
  const bool is_held =
      evidence.stationary || counts.known_seen - counts.known_rejected >= kFewFeatures;
  if (const auto blindness = blindness_monitor_.Add(evidence.features_observed, is_held, newest,
                                                    evidence.pose_covariance)) {
    return Failure{*blindness, /*has_drifted=*/true};
  }
  if (const auto runaway = DetectRunaway(evidence.time_offset_change)) {
    return Failure{*runaway, /*has_drifted=*/true};
  }
  if (const auto jump = DetectFailure(evidence.predicted, newest)) {
    return Failure{*jump};
  }
  return std::nullopt;
}

}  // namespace plm_vins

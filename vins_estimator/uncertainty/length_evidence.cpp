// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/length_evidence.h"

#include <algorithm>
#include <cmath>

#include "vins_estimator/problem/initial_prior.h"

namespace plm_vins {
namespace {

constexpr int kBaselineLength = 2;               // index in the tangent of a mounting
constexpr int kDepthScale = 0, kDepthDelay = 1;  // indices in a depth stream
constexpr double kMaxDeviation = 0.05;           // relative; evidence is ignored beyond it
constexpr double kMinSignificance = 3.0;         // in standard deviations
// Relative standard deviation of the scale factor of an accelerometer. It is not estimated, but
// considered in what the evidence is worth (a consider parameter, [Schmidt1966]).
constexpr double kAccelScaleDeviation = 0.0025;
constexpr double kMinDelay = 0.005;  // [s]

std::optional<LengthEvidence> IfSignificant(const std::optional<LengthEvidence>& evidence) {
  return evidence && IsSignificant(*evidence) ? evidence : std::nullopt;
}

}  // namespace

std::optional<LengthEvidence> WithoutPrior(double estimate, double variance) {
  const double information = 1 / variance - 1 / (kLengthDeviation * kLengthDeviation);
  if (!(information > 1 / (kMaxDeviation * kMaxDeviation))) return std::nullopt;
  return LengthEvidence{estimate / (variance * information),
                        std::hypot(1 / std::sqrt(information), kAccelScaleDeviation)};
}

bool IsSignificant(const LengthEvidence& evidence) {
  return std::abs(evidence.error) > kMinSignificance * evidence.deviation;
}

std::optional<LengthEvidence> BaselineError(const SlidingWindow& window, double stated_length,
                                            NormalEquations* equations) {
  const auto covariance = equations->Covariance({{BlockKind::kMounting, 0}});
  if (!covariance) return std::nullopt;
  const double estimate = std::log(window.T_C_C1().translation.norm() / stated_length);
  return IfSignificant(WithoutPrior(estimate, (*covariance)(kBaselineLength, kBaselineLength)));
}

DepthFaults FaultsOfDepths(const SlidingWindow& window, NormalEquations* equations) {
  const auto known = equations->Covariance({{BlockKind::kDepthStream, 0}});
  if (!known) return {};
  const Eigen::MatrixXd& covariance = *known;
  DepthFaults faults;
  const double scale = window.depth_stream[kDepthScale], delay = window.depth_stream[kDepthDelay];
  faults.scale = IfSignificant(WithoutPrior(scale, covariance(kDepthScale, kDepthScale)));
  const double deviation = std::sqrt(covariance(kDepthDelay, kDepthDelay));
  if (std::abs(delay) > std::max(kMinDelay, kMinSignificance * deviation)) faults.delay = delay;
  return faults;
}

}  // namespace plm_vins

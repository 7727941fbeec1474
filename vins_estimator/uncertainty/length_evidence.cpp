// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/length_evidence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/imu/imu_noise.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {
namespace {

constexpr int kDepthScale = 0, kDepthDelay = 1;  // indices in a depth stream
constexpr double kMaxDeviation = 0.05;           // relative; evidence is ignored beyond it
constexpr double kMinSignificance = 5.0;         // of an error of a length, in standard deviations
constexpr double kMinDelaySigmas = 3.0;
constexpr double kMinDelay = 0.005;  // [s]

std::optional<LengthEvidence> IfSignificant(const std::optional<LengthEvidence>& evidence) {
  return evidence && IsSignificant(*evidence) ? evidence : std::nullopt;
}

}  // namespace

std::optional<LengthEvidence> WithoutPrior(double estimate, double variance, double prior) {
  const double information = 1 / variance - 1 / (prior * prior);
  if (!(information > 1 / (kMaxDeviation * kMaxDeviation))) return std::nullopt;
  return LengthEvidence{estimate / (variance * information),
                        std::hypot(1 / std::sqrt(information), kAccelScaleDeviation)};
}

bool IsSignificant(const LengthEvidence& evidence) {
  return std::abs(evidence.error) > kMinSignificance * evidence.deviation;
}

std::optional<LengthEvidence> BaselineError(const ExtrinsicsLink& pair, const SlidingWindow& window,
                                            NormalEquations* equations) {
  const Eigen::Vector3d baseline_B =
      window.cameras[pair.j].T_B_C().translation - window.cameras[pair.i].T_B_C().translation;
  // The length depends on both positions, unless the extrinsics of the first camera are known.
  std::vector<BlockId> ids = {{BlockKind::kExtrinsic, pair.j}};
  if (equations->IsDense({BlockKind::kExtrinsic, pair.i})) {
    ids.push_back({BlockKind::kExtrinsic, pair.i});
  }
  const auto covariance = equations->Covariance(ids);
  if (!covariance) return std::nullopt;
  const double length = baseline_B.norm();
  Eigen::VectorXd d_log_length = Eigen::VectorXd::Zero(covariance->rows());
  d_log_length.head<3>() = baseline_B / (length * length);
  if (ids.size() > 1) d_log_length.segment<3>(kPoseTangentSize) = -d_log_length.head<3>();
  return IfSignificant(WithoutPrior(std::log(length / pair.T_Ci_Cj.translation.norm()),
                                    d_log_length.dot(*covariance * d_log_length),
                                    kBaselineDeviation));
}

DepthFaults FaultsOfDepths(const SlidingWindow& window, NormalEquations* equations) {
  const auto known = equations->Covariance({{BlockKind::kDepthStream, 0}});
  if (!known) return {};
  const Eigen::MatrixXd& covariance = *known;
  DepthFaults faults;
  const double scale = window.depth_stream[kDepthScale], delay = window.depth_stream[kDepthDelay];
  faults.scale = IfSignificant(
      WithoutPrior(scale, covariance(kDepthScale, kDepthScale), kDepthScaleDeviation));
  const double deviation = std::sqrt(covariance(kDepthDelay, kDepthDelay));
  if (std::abs(delay) > std::max(kMinDelay, kMinDelaySigmas * deviation)) faults.delay = delay;
  return faults;
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/length_evidence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/imu/imu_noise.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {
namespace {

constexpr int kDepthScale = 0, kDepthDelay = 1, kDepthShift = 2;  // indices in a depth stream
constexpr double kMaxDeviation = 0.05;  // relative; evidence is ignored beyond it
constexpr double kMinDelay = 0.005;     // [s]
// Least misalignment that matters, normalized, and where it is judged beside the axis. The slopes
// of scenes with edges show a third to a half of the true one.
constexpr double kMinMisalignment = 0.005, kBesideAxis = 0.5;

// Returns the most significant misalignment, at the axis or beside it in the direction of the
// shift; nullopt if none matters.
std::optional<Misalignment> MisalignmentOf(const DepthStream& stream,
                                           const Eigen::MatrixXd& covariance, double focal_length) {
  const Eigen::Vector2d direction = stream.segment<2>(kDepthShift).normalized();
  std::optional<Misalignment> worst;
  double most = kMinSignificance;
  for (const double beside : {0.0, -kBesideAxis, kBesideAxis}) {
    DepthStream moved = DepthStream::Zero();
    moved.tail<3>() << direction, beside;
    const double distance = std::abs(moved.dot(stream));
    const double deviation = std::sqrt(moved.dot(covariance * moved));
    if (distance < kMinMisalignment || distance < most * deviation) continue;
    most = distance / deviation;
    worst = Misalignment{focal_length * distance, focal_length * deviation};
  }
  return worst;
}

}  // namespace

std::optional<LengthEvidence> WithoutPrior(double estimate, double variance, double prior) {
  const double information = 1 / variance - 1 / (prior * prior);
  if (!(information > 1 / (kMaxDeviation * kMaxDeviation))) return std::nullopt;
  return LengthEvidence{estimate / (variance * information),
                        std::hypot(1 / std::sqrt(information), kAccelScaleDeviation)};
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
  return WithoutPrior(std::log(length / pair.T_Ci_Cj.translation.norm()),
                      d_log_length.dot(*covariance * d_log_length), kBaselineDeviation);
}

DepthFaults FaultsOfDepths(const SlidingWindow& window, double focal_length,
                           NormalEquations* equations) {
  const auto known = equations->Covariance({{BlockKind::kDepthStream, 0}});
  if (!known) return {};
  const Eigen::MatrixXd& covariance = *known;
  DepthFaults faults;
  const double scale = window.depth_stream[kDepthScale], delay = window.depth_stream[kDepthDelay];
  faults.scale = WithoutPrior(scale, covariance(kDepthScale, kDepthScale), kDepthScaleDeviation);
  const double deviation = std::sqrt(covariance(kDepthDelay, kDepthDelay));
  if (std::abs(delay) > std::max(kMinDelay, kMinSignificance * deviation)) faults.delay = delay;
  faults.misalignment =
      MisalignmentOf(DepthStream::Map(window.depth_stream.data()), covariance, focal_length);
  return faults;
}

}  // namespace plm_vins

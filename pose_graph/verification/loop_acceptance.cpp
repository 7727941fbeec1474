// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_acceptance.h"

#include <algorithm>
#include <cmath>

#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr double kMaxDeviations = 2 * kThreeSigmaOf4Dof;  // Mahalanobis distance of agreeing loops
constexpr double kMaxWait = 10;                           // time to wait for an agreeing loop [s]

// Returns T_M_O of the later keyframe's odometry world as measured by the loop.
LevelTransform MapFromOdometry(const std::vector<Keyframe>& keyframes, const PoseGraph& graph,
                               const LoopCandidate& loop) {
  return graph.node(loop.earlier) * loop.T_earlier_later * keyframes[loop.later].T_O_L().Inverse();
}

}  // namespace

std::vector<LoopCandidate> LoopAcceptance::Judge(const std::vector<Keyframe>& keyframes,
                                                 const PoseGraph& graph, LoopCandidate* candidate) {
  candidate->failed = LoopGate::kOdometry;
  if (graph.AreConnected(candidate->earlier, candidate->later)) {
    const LevelTransform predicted =
        graph.node(candidate->earlier).Inverse() * graph.node(candidate->later);
    const double distance = graph.Distance(candidate->earlier, candidate->later);
    candidate->odometry_error = Deviations(EdgeError(candidate->T_earlier_later, predicted),
                                           candidate->covariance + kLoopDrift.Covariance(distance));
    if (*candidate->odometry_error <= kThreeSigmaOf4Dof) {
      candidate->failed.reset();
      return {};
    }
    if (*candidate->odometry_error > kMaxDeviations) return {};
  }

  candidate->failed = LoopGate::kAgreement;
  const auto is_old = [&](const LoopCandidate& other) {
    return ToSeconds(candidate->later_ns - other.later_ns) > kMaxWait;
  };
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), is_old), waiting_.end());
  const auto witness = std::find_if(
      waiting_.begin(), waiting_.end(),
      [&](const LoopCandidate& other) { return Agree(keyframes, graph, other, *candidate); });
  if (witness == waiting_.end()) {
    waiting_.push_back(*candidate);
    return {};
  }
  candidate->failed.reset();
  LoopCandidate confirmed = *witness;
  confirmed.failed.reset();
  waiting_.erase(witness);
  return {confirmed};
}

bool LoopAcceptance::Agree(const std::vector<Keyframe>& keyframes, const PoseGraph& graph,
                           const LoopCandidate& a, const LoopCandidate& b) const {
  const Keyframe& later_a = keyframes[a.later];
  const Keyframe& later_b = keyframes[b.later];
  if (a.later == b.later || later_a.world != later_b.world) return false;
  const double way_earlier = graph.Distance(a.earlier, b.earlier);
  if (!std::isfinite(way_earlier)) return false;
  const LevelTransform here = later_b.T_O_L();
  const Vector4d difference = EdgeError(MapFromOdometry(keyframes, graph, a) * here,
                                        MapFromOdometry(keyframes, graph, b) * here);
  const double way = way_earlier + std::abs(later_b.path - later_a.path);
  const auto covariance = [&graph](const LoopCandidate& loop) {
    return CovarianceInMap(graph.node(loop.earlier), Matrix4d::Zero(), EdgeOf(loop));
  };
  return Deviations(difference, covariance(a) + covariance(b) + kLoopDrift.Covariance(way)) <=
         kThreeSigmaOf4Dof;
}

}  // namespace plm_vins

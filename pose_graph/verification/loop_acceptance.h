// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/graph/pose_graph.h"
#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/keyframes/odometry_noise.h"
#include "pose_graph/verification/loop_candidate.h"

namespace plm_vins {

// Odometry drift that a loop may correct.
constexpr DriftBudget kLoopDrift = {0.05, 0.02, 0.5 * M_PI / 180, 0.05 * M_PI / 180};

// Decides on loops that passed the image-based gates: checks them against odometry, and against
// each other if they request a large correction. Two loops agree if they imply the same T_M_O of
// the odometry's world.
class LoopAcceptance {
 public:
  // Passes the candidate through the gates kOdometry and kAgreement. Returns the waiting loops, at
  // most one, that are accepted together with it.
  std::vector<LoopCandidate> Judge(const std::vector<Keyframe>& keyframes, const PoseGraph& graph,
                                   LoopCandidate* candidate);

  // Drops the waiting loops of a keyframe that is removed from the map.
  void Forget(int keyframe) { ForgetLoopsOf(keyframe, &waiting_); }

 private:
  bool Agree(const std::vector<Keyframe>& keyframes, const PoseGraph& graph, const LoopCandidate& a,
             const LoopCandidate& b) const;

  std::vector<LoopCandidate> waiting_;
};

}  // namespace plm_vins

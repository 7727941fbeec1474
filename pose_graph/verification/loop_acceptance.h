// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/geometry/drift_budget.h"
#include "pose_graph/graph/pose_graph.h"
#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/verification/loop_candidate.h"

namespace plm_vins {

struct LoopAcceptanceOptions {
  DriftBudget drift = {0.05, 0.02, 0.5 * M_PI / 180, 0.05 * M_PI / 180};
  double max_deviations = 2 * kThreeSigmaOf4Dof;  // that two loops which agree may ask for
  double max_wait = 10;                           // for a loop that agrees [s]
};

// Decides on loops that are right as far as the images show: against odometry, and against each
// other where they ask for much. Two loops agree where they say the same of where the odometry's
// world is in the map.
class LoopAcceptance {
 public:
  explicit LoopAcceptance(const LoopAcceptanceOptions& options) : options_(options) {}

  // Takes the candidate through the gates kOdometry and kAgreement. Returns the loops that waited
  // for it and are to be believed with it: one or none.
  std::vector<LoopCandidate> Judge(const std::vector<Keyframe>& keyframes, const PoseGraph& graph,
                                   LoopCandidate* candidate);

  // Drops loops that wait and lead to this keyframe, which leaves the map.
  void Forget(int keyframe) { ForgetLoopsOf(keyframe, &waiting_); }

 private:
  bool Agree(const std::vector<Keyframe>& keyframes, const PoseGraph& graph, const LoopCandidate& a,
             const LoopCandidate& b) const;

  LoopAcceptanceOptions options_;
  std::vector<LoopCandidate> waiting_;
};

}  // namespace plm_vins

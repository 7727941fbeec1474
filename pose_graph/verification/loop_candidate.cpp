// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_candidate.h"

#include <algorithm>

namespace plm_vins {

const char* ToString(LoopGate gate) {
  static constexpr const char* kNames[kLoopGates] = {
      "score",     "repeated",   "apart", "matches",  "pose",      "inliers", "spread",
      "backwards", "refinement", "lines", "odometry", "agreement", "graph"};
  return kNames[static_cast<int>(gate)];
}

void ForgetLoopsOf(int keyframe, std::vector<LoopCandidate>* loops) {
  const auto is_of_keyframe = [keyframe](const LoopCandidate& loop) {
    return loop.earlier == keyframe || loop.later == keyframe;
  };
  loops->erase(std::remove_if(loops->begin(), loops->end(), is_of_keyframe), loops->end());
}

}  // namespace plm_vins

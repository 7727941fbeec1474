// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_candidate.h"

namespace plm_vins {

const char* ToString(LoopGate gate) {
  static constexpr const char* kNames[kLoopGates] = {
      "score",  "repeated",  "apart",      "matches", "pose",     "manhattan", "inliers",
      "spread", "backwards", "refinement", "lines",   "odometry", "agreement", "graph"};
  return kNames[static_cast<int>(gate)];
}

}  // namespace plm_vins

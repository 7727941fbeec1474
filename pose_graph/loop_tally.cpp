// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/loop_tally.h"

namespace plm_vins {

void LoopTally::Add(const LoopClosure& closure) {
  candidates += static_cast<int64_t>(closure.candidates.size());
  dropped += closure.dropped;
  for (const auto* loops : {&closure.candidates, &closure.confirmed}) {
    for (const LoopCandidate& loop : *loops) ++(loop.failed ? refused[*loop.failed] : accepted);
  }
  // They were refused for lack of one that agrees, and have another verdict now.
  if (!closure.confirmed.empty()) {
    refused[LoopGate::kAgreement] -= static_cast<int64_t>(closure.confirmed.size());
  }
}

}  // namespace plm_vins

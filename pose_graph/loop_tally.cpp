// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/loop_tally.h"

namespace plm_vins {

void LoopTally::Add(const LoopClosure& closure) {
  candidates += static_cast<int64_t>(closure.candidates.size());
  dropped += static_cast<int64_t>(closure.dropped.size());
  for (const auto* loops : {&closure.candidates, &closure.confirmed, &closure.reconsidered}) {
    for (const LoopCandidate& loop : *loops) ++(loop.failed ? refused[*loop.failed] : accepted);
  }
  // These loops were counted before under the gate that then rejected them.
  for (size_t i = 0; i < closure.confirmed.size(); ++i) --refused[LoopGate::kAgreement];
  for (size_t i = 0; i < closure.reconsidered.size(); ++i) --refused[LoopGate::kGraph];
}

}  // namespace plm_vins

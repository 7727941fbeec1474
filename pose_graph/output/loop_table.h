// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "pose_graph/verification/loop_candidate.h"

namespace plm_vins {

// The rows of loops.csv: one candidate each, with every gate's value, empty where it was not
// reached, and the gate that refused it, or "accepted".
void WriteLoopHeader(std::ostream* stream);
void WriteLoopRow(const LoopCandidate& candidate, std::ostream* stream);

}  // namespace plm_vins

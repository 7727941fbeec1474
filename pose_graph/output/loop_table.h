// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "pose_graph/verification/loop_candidate.h"

namespace plm_vins {

// Writes loops.csv, one row for each candidate: the values of all gates, empty for gates that were
// not reached, and the gate that rejected it, or "accepted".
void WriteLoopHeader(std::ostream* stream);
void WriteLoopRow(const LoopCandidate& candidate, std::ostream* stream);

}  // namespace plm_vins

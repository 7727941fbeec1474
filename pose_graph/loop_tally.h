// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

#include "pose_graph/loop_closer.h"

namespace plm_vins {

// Loop statistics of a run.
struct LoopTally {
  int64_t candidates = 0;
  int64_t accepted = 0;
  int64_t dropped = 0;  // accepted loops that the graph dropped later
  std::map<LoopGate, int64_t> refused;

  void Add(const LoopClosure& closure);
};

}  // namespace plm_vins

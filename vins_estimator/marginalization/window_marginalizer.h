// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "vins_estimator/map/local_map.h"
#include "vins_estimator/problem/block_id.h"
#include "vins_estimator/problem/marginalization_prior.h"
#include "vins_estimator/problem/problem_options.h"

namespace plm_vins {

// Selects the variables of one frame.
std::function<bool(const BlockId&)> IsOfFrame(int64_t t_ns);

// The prior with the oldest frame folded in: its motion to the next frame, and every landmark that
// it hosts with all views. Its pose stays a variable of the prior where `keep_pose` says so. The
// map stays as it is; what was folded in must not be used again (WindowEstimate sees to it).
MarginalizationPrior MarginalizeOldest(const ProblemOptions& options,
                                       const MarginalizationPrior& prior, LocalMap* map,
                                       bool keep_pose);

}  // namespace plm_vins

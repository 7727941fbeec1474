// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "vins_estimator/equations/marginalization_prior.h"
#include "vins_estimator/equations/variable.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/problem/problem_options.h"

namespace plm_vins {

// Returns a predicate that selects the pose, velocity and biases of one frame.
std::function<bool(const BlockId&)> IsOfFrame(int64_t t_ns);

// Returns the prior with the oldest frame marginalized: its preintegrated measurement to the next
// frame, and every landmark that it hosts with all observations. If `keep_pose`, its pose stays a
// variable of the prior. The map is not changed; the caller must drop from it what was marginalized
// (see WindowEstimate).
MarginalizationPrior MarginalizeOldest(const ProblemOptions& options,
                                       const MarginalizationPrior& prior, LocalMap* map,
                                       bool keep_pose);

}  // namespace plm_vins

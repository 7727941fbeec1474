// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/estimator_config.h"
#include "vins_estimator/optimization/levenberg_marquardt.h"

namespace plm_vins {

// Solves the problem by either solver. `equations` are those of the problem; they stay linearised
// one step before the result at most.
SolverSummary SolveBy(SolverType solver, const SolverOptions& options, const WindowProblem& problem,
                      NormalEquations* equations);

}  // namespace plm_vins

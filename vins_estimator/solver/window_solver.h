// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/estimator_config.h"
#include "vins_estimator/solver/levenberg_marquardt.h"

namespace plm_vins {

// Solves the problem by the given solver. `equations` are those of the problem; on return they are
// linearized at most one step before the result.
SolverSummary SolveBy(SolverType solver, const SolverOptions& options, const WindowProblem& problem,
                      NormalEquations* equations);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/window_solver.h"

#include "vins_estimator/solver/ceres_solver.h"

namespace plm_vins {

SolverSummary SolveBy(SolverType solver, const SolverOptions& options, const WindowProblem& problem,
                      NormalEquations* equations) {
  if (solver == SolverType::kSchur) return Solve(options, problem, equations);
  const SolverSummary summary = SolveByCeres(options, problem);
  equations->Linearize();
  return summary;
}

}  // namespace plm_vins

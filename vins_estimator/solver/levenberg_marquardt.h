// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/equations/window_problem.h"

namespace plm_vins {

struct SolverOptions {
  int max_iterations = 8;
  // Stop when the gain of an iteration, or its difference from the prediction, is at most
  // LeastGain.
  double deviation_tolerance = 0.15;
  double step_tolerance = 1e-6;  // stop when every component of the step is smaller [m, rad, ...]
};

struct SolverSummary {
  double initial_cost = 0;
  double final_cost = 0;
  int iterations = 0;
  // True if the initial cost is finite and the equations have a solution, even if nothing was
  // gained.
  bool solved = false;
};

// Returns the decrease of the cost if each unknown is `deviation_tolerance` standard deviations
// from the minimum. A tolerance relative to the cost would be meaningless: the prior is known up to
// a constant only, so the cost may be negative and falls with each marginalized frame.
double LeastGain(const SolverOptions& options, const WindowProblem& problem);

// Minimizes the problem's cost by Levenberg-Marquardt, starting from the current values of its
// variables, which are replaced by the result. The final cost never exceeds the initial one. The
// number of iterations is bounded, not the time. `equations` are those of the problem; on return
// they are linearized at most one step before the result.
SolverSummary Solve(const SolverOptions& options, const WindowProblem& problem,
                    NormalEquations* equations);

}  // namespace plm_vins

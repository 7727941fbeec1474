// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/problem/normal_equations.h"
#include "vins_estimator/problem/window_problem.h"

namespace plm_vins {

struct SolverOptions {
  int max_iterations = 8;
  // Stop when an iteration gains, or misses of what it was predicted to gain, no more than
  // LeastGain.
  double deviation_tolerance = 0.15;
  double step_tolerance = 1e-6;  // stop when no component of the step is longer [m, rad, ...]
};

struct SolverSummary {
  double initial_cost = 0;
  double final_cost = 0;
  int iterations = 0;
  // The cost of the start is finite, and the equations have a solution; whether or not there was
  // anything to gain.
  bool solved = false;
};

// By how much the cost falls as each unknown moves by `deviation_tolerance` of its standard
// deviations to the minimum. A share of the cost would say nothing: the prior is known but for a
// constant, so the cost falls below zero, and further with each frame that leaves the window.
double LeastGain(const SolverOptions& options, const WindowProblem& problem);

// Minimises the problem's cost from the current values of its variables, which are replaced by the
// result (Levenberg-Marquardt; never ends above the initial cost). Work is bounded by iterations,
// not by time. `equations` are those of the problem; they stay linearised one step before the
// result at most.
SolverSummary Solve(const SolverOptions& options, const WindowProblem& problem,
                    NormalEquations* equations);

}  // namespace plm_vins

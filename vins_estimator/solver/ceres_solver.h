// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/equations/window_problem.h"
#include "vins_estimator/solver/levenberg_marquardt.h"

namespace plm_vins {

// Linear solver for the reduced (frame) equations: dense for a window, sparse for a map.
enum class CeresEquations { kDense, kSparse };

// Solves the problem by ceres::Solve instead of Solve(): same terms, prior and limits, one thread;
// landmarks are eliminated first. All Jacobians are evaluated at the current values. A term that
// cannot be evaluated at the start (a landmark behind a camera) is dropped, because Ceres would
// fail.
//
// Given enough iterations, both solvers reach the same minimum. They differ in damping, in the step
// tolerance, which Ceres takes relative to the norm of all values, and in that Ceres does not stop
// when a step gained what was predicted.
SolverSummary SolveByCeres(const SolverOptions& options, const WindowProblem& problem,
                           CeresEquations equations = CeresEquations::kDense);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/optimization/levenberg_marquardt.h"
#include "vins_estimator/problem/window_problem.h"

namespace plm_vins {

// How the equations of the frames are solved: dense for a window, sparse for a map.
enum class CeresEquations { kDense, kSparse };

// The same as Solve(), by ceres::Solve: the same terms and prior, the same limits, one thread;
// landmarks are eliminated first. All Jacobians are taken at the values. A term that cannot be
// evaluated at the start (a landmark behind a camera) is left out, since Ceres solves nothing then.
//
// Both end at the minimum, if they are given the iterations. On the way they differ: in the
// damping, in the tolerance of steps, which Ceres takes relative to the length of all values, and
// in that Ceres does not stop where a step gained what was predicted.
SolverSummary SolveByCeres(const SolverOptions& options, const WindowProblem& problem,
                           CeresEquations equations = CeresEquations::kDense);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vins_estimator/problem/window_problem.h"

namespace plm_vins {

// Residual and Jacobians of one term, robust weight applied: |residual|^2 and J^T J can be summed
// as they are. Jacobian rows are of ambient size; only the first tangent-size columns count.
struct TermEvaluation {
  static constexpr int kMaxRows = 15;

  int rows = 0;
  double cost = 0;  // 0.5 rho(|r|^2)
  std::array<double, kMaxRows> residual;
  std::array<std::array<double, kMaxRows * kMaxAmbientSize>, ResidualTerm::kMaxVariables> jacobians;
};

// The cost 0.5 rho(|r|^2) of a term at the current values; infinite where it cannot be evaluated (a
// landmark behind a camera).
double EvaluateTermCost(const ResidualTerm& term, const std::vector<Variable>& variables);

// Whether the residual can be evaluated at the current values and at the linearisation points.
bool CanBeEvaluated(const ResidualTerm& term, const std::vector<Variable>& variables);

// Residual and cost at the current values, Jacobians at the linearisation points. False where
// either cannot be evaluated; `evaluation` then means nothing.
bool EvaluateTerm(const ResidualTerm& term, const std::vector<Variable>& variables,
                  TermEvaluation* evaluation);

}  // namespace plm_vins

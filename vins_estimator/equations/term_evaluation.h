// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vins_estimator/equations/window_problem.h"

namespace plm_vins {

// Residual and Jacobians of one term with the robust weight applied, so that |residual|^2 and J^T J
// can be summed directly. Jacobian rows have ambient size; only the first tangent-size columns are
// used.
struct TermEvaluation {
  static constexpr int kMaxRows = 15;

  int rows = 0;
  double cost = 0;  // 0.5 rho(|r|^2)
  std::array<double, kMaxRows> residual;
  std::array<std::array<double, kMaxRows * kMaxAmbientSize>, ResidualTerm::kMaxVariables> jacobians;
};

// Returns the cost 0.5 rho(|r|^2) of a term at the current values; infinite if it cannot be
// evaluated (a landmark behind a camera).
double EvaluateTermCost(const ResidualTerm& term, const std::vector<Variable>& variables);

// Returns whether the residual can be evaluated at the current values and linearization points.
bool CanBeEvaluated(const ResidualTerm& term, const std::vector<Variable>& variables);

// Evaluates residual and cost at the current values, Jacobians at the linearization points. Returns
// false if either fails; `evaluation` is then undefined.
bool EvaluateTerm(const ResidualTerm& term, const std::vector<Variable>& variables,
                  TermEvaluation* evaluation);

}  // namespace plm_vins

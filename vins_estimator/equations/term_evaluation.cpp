// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/term_evaluation.h"

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace plm_vins {
namespace {

using ParameterPointers = std::array<const double*, ResidualTerm::kMaxVariables>;

// Returns value and first derivative of rho at the squared norm.
std::array<double, 2> Robustify(const ceres::LossFunction* loss, double squared_norm) {
  if (loss == nullptr) return {squared_norm, 1.0};
  double rho[3];
  loss->Evaluate(squared_norm, rho);
  return {rho[0], rho[1]};
}

double SquaredNorm(const double* residual, int rows) {
  return Eigen::Map<const Eigen::VectorXd>(residual, rows).squaredNorm();
}

// Collects the current values and the linearization points; returns whether they differ.
bool GatherParameters(const ResidualTerm& term, const std::vector<Variable>& variables,
                      ParameterPointers* values, ParameterPointers* linearization) {
  bool differs = false;
  for (int i = 0; i < term.variable_count; ++i) {
    const Variable& variable = variables[term.variables[i]];
    (*values)[i] = variable.values;
    (*linearization)[i] = variable.values;
    if (variable.linearization != nullptr) {
      (*linearization)[i] = variable.linearization;
      differs = true;
    }
  }
  return differs;
}

// Multiplies residual and Jacobians by `factor`; constants have no Jacobian.
void ScaleBy(double factor, const ResidualTerm& term, const std::vector<Variable>& variables,
             TermEvaluation* evaluation) {
  for (int i = 0; i < evaluation->rows; ++i) evaluation->residual[i] *= factor;
  for (int k = 0; k < term.variable_count; ++k) {
    const Variable& variable = variables[term.variables[k]];
    if (variable.constant) continue;
    const int size = evaluation->rows * variable.type().ambient_size;
    for (int i = 0; i < size; ++i) evaluation->jacobians[k][i] *= factor;
  }
}

}  // namespace

double EvaluateTermCost(const ResidualTerm& term, const std::vector<Variable>& variables) {
  ParameterPointers values;
  for (int i = 0; i < term.variable_count; ++i) values[i] = variables[term.variables[i]].values;
  double residual[TermEvaluation::kMaxRows];
  if (!term.cost->Evaluate(values.data(), residual, nullptr)) {
    return std::numeric_limits<double>::infinity();
  }
  return 0.5 * Robustify(term.loss, SquaredNorm(residual, term.cost->num_residuals()))[0];
}

bool CanBeEvaluated(const ResidualTerm& term, const std::vector<Variable>& variables) {
  ParameterPointers values = {}, linearization = {};
  const bool linearized_elsewhere = GatherParameters(term, variables, &values, &linearization);
  double residual[TermEvaluation::kMaxRows];
  return term.cost->Evaluate(values.data(), residual, nullptr) &&
         (!linearized_elsewhere || term.cost->Evaluate(linearization.data(), residual, nullptr));
}

bool EvaluateTerm(const ResidualTerm& term, const std::vector<Variable>& variables,
                  TermEvaluation* evaluation) {
  ParameterPointers values = {}, linearization = {};
  const bool linearized_elsewhere = GatherParameters(term, variables, &values, &linearization);
  std::array<double*, ResidualTerm::kMaxVariables> jacobians;
  for (int i = 0; i < term.variable_count; ++i) {
    const bool constant = variables[term.variables[i]].constant;
    jacobians[i] = constant ? nullptr : evaluation->jacobians[i].data();
  }
  evaluation->rows = term.cost->num_residuals();
  double* residual = evaluation->residual.data();
  if (!term.cost->Evaluate(linearization.data(), residual, jacobians.data()) ||
      (linearized_elsewhere && !term.cost->Evaluate(values.data(), residual, nullptr))) {
    return false;
  }
  const auto [cost, weight] = Robustify(term.loss, SquaredNorm(residual, evaluation->rows));
  evaluation->cost = 0.5 * cost;
  if (weight != 1.0) ScaleBy(std::sqrt(weight), term, variables, evaluation);
  return true;
}

}  // namespace plm_vins

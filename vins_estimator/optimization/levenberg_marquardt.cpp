// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/optimization/levenberg_marquardt.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace plm_vins {
namespace {

constexpr double kFirstDamping = 1e-5;  // none is needed until a step goes wrong
constexpr double kDampingIncrease = 10.0;
constexpr double kDampingDecrease = 0.1;
constexpr double kMinDamping = 1e-7;  // below that, none
constexpr double kMaxDamping = 1e3;

// The values of all variables, to go back to after a step that did not help.
class Snapshot {
 public:
  explicit Snapshot(const std::vector<Variable>& variables) : variables_(variables) { Take(); }

  void Take() {
    values_.clear();
    for (const Variable& variable : variables_) {
      values_.insert(values_.end(), variable.values, variable.values + Size(variable));
    }
  }

  void Restore() const {
    const double* next = values_.data();
    for (const Variable& variable : variables_) {
      std::copy(next, next + Size(variable), variable.values);
      next += Size(variable);
    }
  }

 private:
  static int Size(const Variable& variable) { return variable.type().ambient_size; }

  const std::vector<Variable>& variables_;
  std::vector<double> values_;
};

void Move(const Variable& variable, const double* step) {
  double moved[kMaxAmbientSize];
  variable.type().plus(variable.values, step, moved);
  std::copy(moved, moved + variable.type().ambient_size, variable.values);
}

// Moves every variable along the solution of the damped equations. Returns the largest component of
// the dense step; negative where there is no solution (nothing is moved then).
double TakeStep(const WindowProblem& problem, double damping, NormalEquations* equations) {
  const Eigen::VectorXd step = equations->DenseStep(damping);
  if (step.size() != equations->dense_size() || !step.allFinite()) return -1;

  for (size_t i = 0; i < problem.landmarks().size(); ++i) {
    const auto landmark_step = equations->LandmarkStep(static_cast<int>(i), step, damping);
    Move(problem.variables()[problem.landmarks()[i].variable], landmark_step.data());
  }
  for (size_t i = 0; i < problem.variables().size(); ++i) {
    const int offset = equations->DenseOffset(static_cast<int>(i));
    if (offset >= 0) Move(problem.variables()[i], &step[offset]);
  }
  return step.size() == 0 ? 0.0 : step.lpNorm<Eigen::Infinity>();
}

}  // namespace

SolverSummary Solve(const SolverOptions& options, const WindowProblem& problem,
                    NormalEquations* equations) {
  Snapshot snapshot(problem.variables());
  SolverSummary summary;
  double cost = equations->Linearize();
  summary.initial_cost = summary.final_cost = cost;
  if (!std::isfinite(cost)) return summary;

  double damping = 0;
  while (summary.iterations < options.max_iterations && damping < kMaxDamping) {
    ++summary.iterations;
    const double step_size = TakeStep(problem, damping, equations);
    const double new_cost = step_size < 0 ? cost : equations->Cost();
    const bool accepted = step_size >= 0 && std::isfinite(new_cost) && new_cost <= cost;
    if (!accepted) {
      snapshot.Restore();
      damping = std::max(damping * kDampingIncrease, kFirstDamping);
      continue;
    }
    summary.solved = true;
    const double gain = cost - new_cost;
    cost = summary.final_cost = new_cost;
    if (gain <= options.cost_tolerance * std::abs(cost) || step_size < options.step_tolerance)
      break;
    snapshot.Take();
    damping *= kDampingDecrease;
    if (damping < kMinDamping) damping = 0;
    if (summary.iterations < options.max_iterations) equations->Linearize();
  }
  return summary;
}

}  // namespace plm_vins

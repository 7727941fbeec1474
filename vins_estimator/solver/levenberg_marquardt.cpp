// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/levenberg_marquardt.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

namespace plm_vins {
namespace {

constexpr double kFirstDamping = 1e-5;  // used from the first rejected step on
constexpr double kDampingIncrease = 10.0;
constexpr double kDampingDecrease = 0.1;
constexpr double kMinDamping = 1e-7;  // smaller damping becomes zero
constexpr double kMaxDamping = 1e3;

// Values of all variables, to restore after a rejected step.
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

struct Step {
  double size = 0;            // largest component of its dense part
  double predicted_gain = 0;  // decrease of the cost if it is exactly quadratic
};

// Moves every variable by the solution of the damped equations; returns nullopt, moving nothing, if
// there is none.
std::optional<Step> TakeStep(const WindowProblem& problem, double damping,
                             NormalEquations* equations) {
  const Eigen::VectorXd dense_step = equations->DenseStep(damping);
  if (dense_step.size() != equations->dense_size() || !dense_step.allFinite()) return std::nullopt;

  Step step;
  for (size_t i = 0; i < problem.landmarks().size(); ++i) {
    const int index = static_cast<int>(i);
    const LandmarkVector landmark_step = equations->LandmarkStep(index, dense_step, damping);
    step.predicted_gain += equations->LandmarkGain(index, landmark_step, damping);
    Move(problem.variables()[problem.landmarks()[i].variable], landmark_step.data());
  }
  for (size_t i = 0; i < problem.variables().size(); ++i) {
    const int offset = equations->DenseOffset(static_cast<int>(i));
    if (offset >= 0) Move(problem.variables()[i], &dense_step[offset]);
  }
  if (dense_step.size() > 0) {
    step.predicted_gain += equations->DenseGain(dense_step, damping);
    step.size = dense_step.lpNorm<Eigen::Infinity>();
  }
  return step;
}

// Returns whether another step would gain little: this one did, or its gain was as predicted, which
// shows the same without a second step.
bool HasConverged(const Step& step, double gain, double least_gain, double step_tolerance) {
  return gain <= least_gain || std::abs(gain - step.predicted_gain) <= least_gain ||
         step.size < step_tolerance;
}

}  // namespace

double LeastGain(const SolverOptions& options, const WindowProblem& problem) {
  int unknowns = 0;
  for (const Variable& variable : problem.variables()) {
    if (!variable.constant) unknowns += variable.type().tangent_size;
  }
  return 0.5 * options.deviation_tolerance * options.deviation_tolerance * unknowns;
}

SolverSummary Solve(const SolverOptions& options, const WindowProblem& problem,
                    NormalEquations* equations) {
  Snapshot snapshot(problem.variables());
  SolverSummary summary;
  double cost = equations->Linearize();
  summary.initial_cost = summary.final_cost = cost;
  if (!std::isfinite(cost)) return summary;

  const double least_gain = LeastGain(options, problem);
  double damping = 0;
  while (summary.iterations < options.max_iterations && damping < kMaxDamping) {
    const std::optional<Step> step = TakeStep(problem, damping, equations);
    if (step) {
      summary.solved = true;
      ++summary.iterations;
    }
    const double new_cost = step ? equations->Cost() : cost;
    const bool accepted = step && std::isfinite(new_cost) && new_cost <= cost;
    if (!accepted) {
      snapshot.Restore();
      damping = std::max(damping * kDampingIncrease, kFirstDamping);
      continue;
    }
    const double gain = cost - new_cost;
    cost = summary.final_cost = new_cost;
    if (HasConverged(*step, gain, least_gain, options.step_tolerance)) break;
    snapshot.Take();
    damping *= kDampingDecrease;
    if (damping < kMinDamping) damping = 0;
    if (summary.iterations < options.max_iterations) equations->Linearize();
  }
  return summary;
}

}  // namespace plm_vins

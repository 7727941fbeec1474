// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/ceres_solver.h"

#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "vins_estimator/equations/term_evaluation.h"
#include "vins_estimator/solver/ceres_adapters.h"

namespace plm_vins {
namespace {

ceres::Problem::Options BorrowedCosts() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

// A WindowProblem as a ceres::Problem, on a copy of its values. Ceres eliminates blocks in the
// order of their addresses; in one array that is the order of the variables, so the result is
// bitwise the same wherever the window is in memory.
class CeresProblem {
 public:
  explicit CeresProblem(const WindowProblem& window) : window_(window), problem_(BorrowedCosts()) {
    AddVariables();
    for (const ResidualTerm& term : window.terms()) AddTerm(term);
    for (const LandmarkTerms& landmark : window.landmarks()) {
      for (const ResidualTerm& term : landmark.terms) AddTerm(term);
    }
    if (window.prior() != nullptr && !window.prior()->empty()) AddPrior(*window.prior());
  }

  ceres::Problem* problem() { return &problem_; }

  // Offset of Ceres' costs relative to those of the window.
  double constant() const { return prior_ ? prior_->constant() : 0; }

  // Returns the elimination order: landmarks first, then frames.
  std::shared_ptr<ceres::ParameterBlockOrdering> Ordering() const {
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (double* block : blocks_) ordering->AddElementToGroup(block, 1);
    for (const LandmarkTerms& landmark : window_.landmarks()) {
      ordering->AddElementToGroup(blocks_[landmark.variable], 0);
    }
    return ordering;
  }

  void CopyValuesToWindow() const {
    for (size_t i = 0; i < blocks_.size(); ++i) {
      const Variable& variable = window_.variables()[i];
      std::copy(blocks_[i], blocks_[i] + variable.type().ambient_size, variable.values);
    }
  }

 private:
  void AddVariables() {
    values_.resize(window_.variables().size() * kMaxAmbientSize);
    double* block = values_.data();
    for (const Variable& variable : window_.variables()) {
      const VariableType& type = variable.type();
      std::copy(variable.values, variable.values + type.ambient_size, block);
      problem_.AddParameterBlock(block, type.ambient_size);
      SetManifold(&problem_, block, type);
      if (variable.constant) problem_.SetParameterBlockConstant(block);
      blocks_.push_back(block);
      block += kMaxAmbientSize;
    }
  }

  void AddTerm(const ResidualTerm& term) {
    if (!CanBeEvaluated(term, window_.variables())) return;
    std::vector<double*> blocks(term.variable_count);
    std::vector<int> sizes(term.variable_count);
    for (int k = 0; k < term.variable_count; ++k) {
      blocks[k] = blocks_[term.variables[k]];
      sizes[k] = window_.variables()[term.variables[k]].type().ambient_size;
    }
    costs_.push_back(std::make_unique<FactorCost>(term.cost, sizes));
    Add(costs_.back().get(), term.loss, blocks);
  }

  void AddPrior(const MarginalizationPrior& prior) {
    std::vector<double*> blocks;
    for (const MarginalizationPrior::Block& block : prior.blocks()) {
      blocks.push_back(blocks_[window_.Find(block.id)]);
    }
    prior_ = std::make_unique<PriorCost>(prior);
    Add(prior_.get(), nullptr, blocks);
  }

  // Ceres' interface takes non-const pointers, but neither cost nor loss has mutable state.
  void Add(const ceres::CostFunction* cost, const ceres::LossFunction* loss,
           const std::vector<double*>& blocks) {
    problem_.AddResidualBlock(const_cast<ceres::CostFunction*>(cost),
                              const_cast<ceres::LossFunction*>(loss), blocks);
  }

  const WindowProblem& window_;
  std::vector<double> values_;
  std::vector<double*> blocks_;  // parameter blocks, by variable
  std::vector<std::unique_ptr<const FactorCost>> costs_;
  std::unique_ptr<const PriorCost> prior_;
  ceres::Problem problem_;  // last: it refers to the members above
};

// Stops the solver when a step gains at most `least_gain`.
class EndOfGain final : public ceres::IterationCallback {
 public:
  explicit EndOfGain(double least_gain) : least_gain_(least_gain) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const bool ended =
        summary.iteration > 0 && summary.step_is_successful && summary.cost_change <= least_gain_;
    return ended ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const double least_gain_;
};

// Initial radius of the trust region: practically undamped.
constexpr double kInitialRadius = 1e5;

ceres::Solver::Options ToCeres(const SolverOptions& options, CeresEquations equations) {
  ceres::Solver::Options result;
  // For SPARSE_SCHUR, Ceres uses SuiteSparse if available; a map takes 25 % longer with Eigen's
  // solver.
  result.linear_solver_type =
      equations == CeresEquations::kDense ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  result.num_threads = 1;
  result.logging_type = ceres::SILENT;
  result.max_num_iterations = options.max_iterations;
  result.initial_trust_region_radius = kInitialRadius;
  result.function_tolerance = 0;  // relative to the cost; EndOfGain is used instead
  result.parameter_tolerance = options.step_tolerance;
  result.gradient_tolerance = 0;
  return result;
}

}  // namespace

SolverSummary SolveByCeres(const SolverOptions& options, const WindowProblem& window,
                           CeresEquations equations) {
  CeresProblem problem(window);
  ceres::Solver::Options ceres_options = ToCeres(options, equations);
  ceres_options.linear_solver_ordering = problem.Ordering();
  EndOfGain end_of_gain(LeastGain(options, window));
  ceres_options.callbacks.push_back(&end_of_gain);
  ceres::Solver::Summary ceres_summary;
  ceres::Solve(ceres_options, problem.problem(), &ceres_summary);

  SolverSummary summary;
  summary.initial_cost = ceres_summary.initial_cost - problem.constant();
  summary.final_cost = ceres_summary.final_cost - problem.constant();
  // The first entry is the initial evaluation.
  summary.iterations = std::max(static_cast<int>(ceres_summary.iterations.size()) - 1, 0);
  summary.solved = ceres_summary.IsSolutionUsable();
  if (summary.solved) problem.CopyValuesToWindow();
  return summary;
}

}  // namespace plm_vins

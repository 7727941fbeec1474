// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/normal_equations.h"

#include <stdexcept>

#include "vins_estimator/equations/marginalization_prior.h"
#include "vins_estimator/equations/term_accumulation.h"
#include "vins_estimator/equations/term_evaluation.h"

namespace plm_vins {

NormalEquations::NormalEquations(const WindowProblem& problem)
    : problem_(problem),
      layout_(problem),
      left_out_(layout_.terms().size(), false),
      H_dd_(layout_.dense_size(), layout_.dense_size()),
      b_d_(layout_.dense_size()) {
  int columns = 0;
  for (const std::vector<ColumnRun>& runs : layout_.landmarks()) columns += CountColumns(runs);
  H_ld_.resize(kMaxLandmarkSize * columns);
  landmarks_.reserve(problem.landmarks().size());
  double* memory = H_ld_.data();
  for (const LandmarkTerms& landmark : problem.landmarks()) {
    const int size = problem.variables()[landmark.variable].type().tangent_size;
    landmarks_.emplace_back(size, layout_.landmarks()[landmarks_.size()], memory);
    memory += landmarks_.back().H_ld.size();
  }
}

double NormalEquations::Linearize() {
  factor_.reset();
  H_dd_.setZero();
  b_d_.setZero();
  for (LandmarkEquations& equations : landmarks_) equations.SetZero();
  double cost = AddPrior();
  for (size_t i = 0; i < left_out_.size(); ++i) {
    left_out_[i] = left_out_[i] || !AddTerm(layout_.terms()[i], &cost);
  }
  return cost;
}

double NormalEquations::Cost() const {
  double cost = 0;
  if (problem_.prior() != nullptr) cost += problem_.prior()->Cost(problem_);
  for (size_t i = 0; i < left_out_.size(); ++i) {
    if (left_out_[i]) continue;
    cost += EvaluateTermCost(*layout_.terms()[i].term, problem_.variables());
  }
  return cost;
}

// Returns false if the term cannot be evaluated.
bool NormalEquations::AddTerm(const TermLayout& layout, double* cost) {
  TermEvaluation evaluation;
  if (!EvaluateTerm(*layout.term, problem_.variables(), &evaluation)) return false;
  AddToDense(layout, evaluation, &H_dd_, &b_d_);
  if (layout.landmark >= 0) AddToLandmark(layout, evaluation, &landmarks_[layout.landmark]);
  *cost += evaluation.cost;
  return true;
}

double NormalEquations::AddPrior() {
  if (problem_.prior() == nullptr) return 0;
  return problem_.prior()->AddTo(problem_, layout_.dense_offset(), &H_dd_, &b_d_);
}

void NormalEquations::Reduce(double damping, Eigen::MatrixXd* S, Eigen::VectorXd* g) const {
  *S = H_dd_;
  S->diagonal() *= 1.0 + damping;
  *g = b_d_;
  EliminateLandmarks(landmarks_, damping, S, g);
}

bool NormalEquations::Factor(double damping) {
  if (!factor_ || factor_damping_ != damping) {
    Reduce(damping, &S_, &g_);
    factor_.emplace(layout_.motion_size(), &S_);
    factor_damping_ = damping;
  }
  return factor_->success();
}

Eigen::VectorXd NormalEquations::DenseStep(double damping) {
  if (!Factor(damping)) return {};
  return -factor_->Solve(g_);
}

LandmarkVector NormalEquations::LandmarkStep(int index, const Eigen::VectorXd& dense_step,
                                             double damping) const {
  return SolveLandmark(landmarks_[index], dense_step, damping);
}

double NormalEquations::DenseGain(const Eigen::VectorXd& step, double damping) const {
  return -0.5 * b_d_.dot(step) + 0.5 * damping * step.cwiseAbs2().dot(H_dd_.diagonal());
}

double NormalEquations::LandmarkGain(int index, const LandmarkVector& step, double damping) const {
  const LandmarkEquations& landmark = landmarks_[index];
  return -0.5 * landmark.b_l.dot(step) +
         0.5 * damping * step.cwiseAbs2().dot(landmark.H_ll.diagonal());
}

std::optional<Eigen::MatrixXd> NormalEquations::Covariance(const std::vector<BlockId>& ids) {
  if (!Factor(0)) return std::nullopt;

  std::vector<int> rows;
  for (const BlockId& id : ids) {
    if (!IsDense(id)) {
      throw std::invalid_argument("covariance requested for a variable that is not dense");
    }
    const int variable = problem_.Find(id);
    const int size = problem_.variables()[variable].type().tangent_size;
    for (int i = 0; i < size; ++i) rows.push_back(DenseOffset(variable) + i);
  }
  return factor_->InverseBlock(rows);
}

}  // namespace plm_vins

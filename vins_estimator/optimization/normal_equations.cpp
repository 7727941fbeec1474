// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/optimization/normal_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "vins_estimator/marginalization/marginalization_prior.h"
#include "vins_estimator/optimization/term_evaluation.h"

namespace plm_vins {
namespace {

constexpr int kMaxTermColumns = ResidualTerm::kMaxVariables * kMaxTangentSize;

// Keeps the equations of an unobserved landmark solvable; far below any real information.
constexpr double kMinLandmarkInformation = 1e-9;

// The dense columns of a term's Jacobian, packed column by column, and where they belong.
struct PackedJacobian {
  int columns = 0;
  std::array<double, kMaxTermColumns * TermEvaluation::kMaxRows> values;
  std::array<int, kMaxTermColumns> dense_column;
  std::array<int, kMaxTermColumns> local_column;
};

inline double Dot(const double* a, const double* b, int rows) {
  double sum = 0;
  for (int i = 0; i < rows; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

NormalEquations::NormalEquations(const WindowProblem& problem) : problem_(problem) {
  std::vector<bool> is_landmark(problem.variables().size(), false);
  for (const LandmarkTerms& landmark : problem.landmarks()) is_landmark[landmark.variable] = true;
  for (size_t i = 0; i < problem.variables().size(); ++i) {
    const Variable& variable = problem.variables()[i];
    const bool dense = !variable.constant && !is_landmark[i];
    dense_offset_.push_back(dense ? dense_size_ : -1);
    if (dense) dense_size_ += variable.type().tangent_size;
  }
  for (const ResidualTerm& term : problem.terms()) layouts_.push_back(LayOut(term, -1));
  landmarks_.resize(problem.landmarks().size());
  for (size_t i = 0; i < landmarks_.size(); ++i) LayOutLandmark(static_cast<int>(i));
  H_dd_.resize(dense_size_, dense_size_);
  b_d_.resize(dense_size_);
}

NormalEquations::TermLayout NormalEquations::LayOut(const ResidualTerm& term, int landmark) const {
  TermLayout layout;
  layout.term = &term;
  layout.landmark = landmark;
  for (int block = 0; block < term.variable_count; ++block) {
    const int variable = term.variables[block];
    if (landmark >= 0 && variable == problem_.landmarks()[landmark].variable) {
      layout.landmark_block = block;
    } else if (dense_offset_[variable] >= 0) {
      const int size = problem_.variables()[variable].type().tangent_size;
      layout.slots.push_back({block, size, dense_offset_[variable], 0});
    }
  }
  std::sort(layout.slots.begin(), layout.slots.end(),
            [](const Slot& a, const Slot& b) { return a.dense_offset < b.dense_offset; });
  return layout;
}

void NormalEquations::LayOutLandmark(int index) {
  const LandmarkTerms& landmark = problem_.landmarks()[index];
  LandmarkEquations& equations = landmarks_[index];
  std::vector<std::pair<int, int>> blocks;  // dense offset, size
  const size_t first = layouts_.size();
  for (const ResidualTerm& term : landmark.terms) {
    layouts_.push_back(LayOut(term, index));
    for (const Slot& slot : layouts_.back().slots) {
      blocks.emplace_back(slot.dense_offset, slot.size);
    }
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  std::vector<int> local_offset(dense_size_, 0);
  for (const auto& [offset, size] : blocks) {
    local_offset[offset] = static_cast<int>(equations.dense_columns.size());
    for (int i = 0; i < size; ++i) equations.dense_columns.push_back(offset + i);
  }
  for (size_t i = first; i < layouts_.size(); ++i) {
    for (Slot& slot : layouts_[i].slots) slot.local_offset = local_offset[slot.dense_offset];
  }
  const int size = problem_.variables()[landmark.variable].type().tangent_size;
  equations.H_ll.resize(size, size);
  equations.b_l.resize(size);
  equations.H_ld.resize(size, equations.dense_columns.size());
}

double NormalEquations::Linearize() {
  H_dd_.setZero();
  b_d_.setZero();
  for (LandmarkEquations& equations : landmarks_) {
    equations.H_ll.setZero();
    equations.b_l.setZero();
    equations.H_ld.setZero();
  }
  double cost = AddPrior();
  for (const TermLayout& layout : layouts_) cost += AddTerm(layout);
  return cost;
}

double NormalEquations::Cost() const {
  const std::vector<Variable>& variables = problem_.variables();
  double cost = 0;
  if (problem_.prior() != nullptr) cost += problem_.prior()->Cost(problem_);
  for (const TermLayout& layout : layouts_) cost += EvaluateTermCost(*layout.term, variables);
  return cost;
}

double NormalEquations::AddTerm(const TermLayout& layout) {
  const std::vector<Variable>& variables = problem_.variables();
  TermEvaluation evaluation;
  if (!EvaluateTerm(*layout.term, variables, &evaluation)) return evaluation.cost;

  const int rows = evaluation.rows;
  PackedJacobian J;
  for (const Slot& slot : layout.slots) {
    const int stride = variables[layout.term->variables[slot.block]].type().ambient_size;
    const double* block = evaluation.jacobians[slot.block].data();
    for (int c = 0; c < slot.size; ++c, ++J.columns) {
      double* column = &J.values[J.columns * rows];
      for (int r = 0; r < rows; ++r) column[r] = block[r * stride + c];
      J.dense_column[J.columns] = slot.dense_offset + c;
      J.local_column[J.columns] = slot.local_offset + c;
    }
  }
  const double* residual = evaluation.residual.data();
  for (int j = 0; j < J.columns; ++j) {
    const double* column = &J.values[j * rows];
    double* target = &H_dd_(0, J.dense_column[j]);
    for (int i = 0; i <= j; ++i) {
      target[J.dense_column[i]] += Dot(&J.values[i * rows], column, rows);
    }
    b_d_[J.dense_column[j]] += Dot(column, residual, rows);
  }
  if (layout.landmark < 0) return evaluation.cost;

  LandmarkEquations& equations = landmarks_[layout.landmark];
  const int size = static_cast<int>(equations.b_l.size());
  const int variable = layout.term->variables[layout.landmark_block];
  const int stride = variables[variable].type().ambient_size;
  const double* block = evaluation.jacobians[layout.landmark_block].data();
  for (int l = 0; l < size; ++l) {
    std::array<double, TermEvaluation::kMaxRows> column;
    for (int r = 0; r < rows; ++r) column[r] = block[r * stride + l];
    for (int k = 0; k < size; ++k) {
      for (int r = 0; r < rows; ++r) equations.H_ll(l, k) += column[r] * block[r * stride + k];
    }
    for (int j = 0; j < J.columns; ++j) {
      equations.H_ld(l, J.local_column[j]) += Dot(column.data(), &J.values[j * rows], rows);
    }
    equations.b_l[l] += Dot(column.data(), residual, rows);
  }
  return evaluation.cost;
}

double NormalEquations::AddPrior() {
  if (problem_.prior() == nullptr) return 0;
  return problem_.prior()->AddTo(problem_, dense_offset_, &H_dd_, &b_d_);
}

NormalEquations::LandmarkMatrix NormalEquations::DampedInverse(const LandmarkEquations& equations,
                                                               double damping) const {
  LandmarkMatrix H = equations.H_ll;
  H.diagonal() *= 1.0 + damping;
  H.diagonal().array() += kMinLandmarkInformation;
  return H.llt().solve(LandmarkMatrix::Identity(H.rows(), H.rows()));
}

void NormalEquations::Reduce(double damping, Eigen::MatrixXd* S, Eigen::VectorXd* g) const {
  *S = H_dd_;
  S->diagonal() *= 1.0 + damping;
  *g = b_d_;
  for (const LandmarkEquations& equations : landmarks_) {
    const LandmarkMatrix inverse = DampedInverse(equations, damping);
    const int columns = static_cast<int>(equations.dense_columns.size());
    for (int l = 0; l < inverse.rows(); ++l) {
      Eigen::RowVectorXd scaled = inverse.row(l) * equations.H_ld;
      for (int j = 0; j < columns; ++j) {
        double* target = &(*S)(0, equations.dense_columns[j]);
        const double factor = equations.H_ld(l, j);
        for (int i = 0; i <= j; ++i) target[equations.dense_columns[i]] -= scaled[i] * factor;
        (*g)[equations.dense_columns[j]] -= scaled[j] * equations.b_l[l];
      }
    }
  }
  S->triangularView<Eigen::StrictlyLower>() = S->transpose();
}

NormalEquations::LandmarkVector NormalEquations::LandmarkStep(int index,
                                                              const Eigen::VectorXd& dense_step,
                                                              double damping) const {
  const LandmarkEquations& equations = landmarks_[index];
  LandmarkVector right = -equations.b_l;
  for (size_t j = 0; j < equations.dense_columns.size(); ++j) {
    right -= equations.H_ld.col(j) * dense_step[equations.dense_columns[j]];
  }
  return DampedInverse(equations, damping) * right;
}

Eigen::MatrixXd NormalEquations::Covariance(const std::vector<BlockId>& ids) const {
  Eigen::MatrixXd S;
  Eigen::VectorXd g;
  Reduce(0, &S, &g);
  const Eigen::VectorXd scale = S.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * S * scale.asDiagonal());
  if (factor.info() != Eigen::Success) return {};

  std::vector<int> rows;
  for (const BlockId& id : ids) {
    const int variable = problem_.Find(id);
    const int size = problem_.variables()[variable].type().tangent_size;
    for (int i = 0; i < size; ++i) rows.push_back(dense_offset_[variable] + i);
  }
  Eigen::MatrixXd selection = Eigen::MatrixXd::Zero(dense_size_, rows.size());
  for (size_t i = 0; i < rows.size(); ++i) selection(rows[i], i) = scale[rows[i]];
  const Eigen::MatrixXd half = factor.matrixL().solve(selection);
  return half.transpose() * half;
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/normal_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "vins_estimator/problem/marginalization_prior.h"
#include "vins_estimator/problem/scaled_cholesky.h"
#include "vins_estimator/problem/term_evaluation.h"

namespace plm_vins {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

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

// Adds J^T J to the upper triangle of H and J^T r to b. Two rows, as corners have, are worth their
// own code: most of the terms are corners.
template <int kRows>
void Accumulate(const PackedJacobian& J, const double* residual, int dynamic_rows,
                Eigen::MatrixXd* H, Eigen::VectorXd* b) {
  const int rows = kRows > 0 ? kRows : dynamic_rows;
  for (int j = 0; j < J.columns; ++j) {
    const double* column = &J.values[j * rows];
    double* target = &(*H)(0, J.dense_column[j]);
    for (int i = 0; i <= j; ++i) {
      target[J.dense_column[i]] += Dot(&J.values[i * rows], column, rows);
    }
    (*b)[J.dense_column[j]] += Dot(column, residual, rows);
  }
}

// S -= W^T W, upper triangle, for W of kRows rows whose columns belong to `runs` of columns of S.
template <int kRows, typename ColumnRuns>
void SubtractGramOfRows(const RowMajorMatrix& W, const ColumnRuns& runs, Eigen::MatrixXd* S) {
  for (auto right = runs.begin(); right != runs.end(); ++right) {
    for (int j = 0; j < right->size; ++j) {
      const Eigen::Matrix<double, kRows, 1> factor = W.col(right->local + j);
      for (auto left = runs.begin(); left <= right; ++left) {
        const int size = left == right ? j + 1 : left->size;
        const double* __restrict__ row = &W(0, left->local);
        double* __restrict__ target = &(*S)(left->dense, right->dense + j);
        for (int i = 0; i < size; ++i) {
          double sum = 0;
          for (int l = 0; l < kRows; ++l) sum += factor[l] * row[l * W.cols() + i];
          target[i] -= sum;
        }
      }
    }
  }
}

template <typename ColumnRuns>
void SubtractGram(const RowMajorMatrix& W, const ColumnRuns& runs, Eigen::MatrixXd* S) {
  switch (W.rows()) {
    case 1:
      return SubtractGramOfRows<1>(W, runs, S);
    case 2:
      return SubtractGramOfRows<2>(W, runs, S);
    case 3:
      return SubtractGramOfRows<3>(W, runs, S);
    default:
      return SubtractGramOfRows<NormalEquations::kMaxLandmarkSize>(W, runs, S);
  }
}

// The damped H_ll as L L^T.
template <typename LandmarkMatrix>
Eigen::LLT<LandmarkMatrix> Factor(const LandmarkMatrix& H_ll, double damping) {
  LandmarkMatrix H = H_ll;
  H.diagonal() *= 1.0 + damping;
  H.diagonal().array() += kMinLandmarkInformation;
  return Eigen::LLT<LandmarkMatrix>(H);
}

}  // namespace

NormalEquations::NormalEquations(const WindowProblem& problem) : problem_(problem) {
  LayOutFrameVariables();
  for (const ResidualTerm& term : problem.terms()) layouts_.push_back(LayOut(term, -1));
  landmarks_.resize(problem.landmarks().size());
  for (size_t i = 0; i < landmarks_.size(); ++i) LayOutLandmark(static_cast<int>(i));
  H_dd_.resize(dense_size_, dense_size_);
  b_d_.resize(dense_size_);
}

// Poses first, so that the frames of a landmark are neighbours in the equations.
void NormalEquations::LayOutFrameVariables() {
  const std::vector<Variable>& variables = problem_.variables();
  std::vector<bool> is_dense(variables.size());
  for (size_t i = 0; i < variables.size(); ++i) is_dense[i] = !variables[i].constant;
  for (const LandmarkTerms& landmark : problem_.landmarks()) is_dense[landmark.variable] = false;
  dense_offset_.assign(variables.size(), -1);
  for (const bool poses : {true, false}) {
    for (size_t i = 0; i < variables.size(); ++i) {
      if (!is_dense[i] || (variables[i].id.kind == BlockKind::kPose) != poses) continue;
      dense_offset_[i] = dense_size_;
      dense_size_ += variables[i].type().tangent_size;
    }
  }
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
  int columns = 0;
  for (const auto& [offset, size] : blocks) {
    local_offset[offset] = columns;
    const bool continues = !equations.runs.empty() &&
                           equations.runs.back().dense + equations.runs.back().size == offset;
    if (!continues) equations.runs.push_back({columns, offset, 0});
    equations.runs.back().size += size;
    columns += size;
  }
  for (size_t i = first; i < layouts_.size(); ++i) {
    for (Slot& slot : layouts_[i].slots) slot.local_offset = local_offset[slot.dense_offset];
  }
  const int size = problem_.variables()[landmark.variable].type().tangent_size;
  equations.H_ll.resize(size, size);
  equations.b_l.resize(size);
  equations.H_ld.resize(size, columns);
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
  if (rows == 2) {
    Accumulate<2>(J, residual, rows, &H_dd_, &b_d_);
  } else {
    Accumulate<0>(J, residual, rows, &H_dd_, &b_d_);
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

void NormalEquations::Reduce(double damping, Eigen::MatrixXd* S, Eigen::VectorXd* g) const {
  *S = H_dd_;
  S->diagonal() *= 1.0 + damping;
  *g = b_d_;
  RowMajorMatrix W;
  for (const LandmarkEquations& equations : landmarks_) {
    // H_dl H_ll^-1 H_ld = W^T W with W = L^-1 H_ld.
    const auto factor = Factor(equations.H_ll, damping);
    W = equations.H_ld;
    factor.matrixL().solveInPlace(W);
    const LandmarkVector w_b = factor.matrixL().solve(equations.b_l);
    for (const ColumnRun& run : equations.runs) {
      const auto W_run = W.middleCols(run.local, run.size);
      g->segment(run.dense, run.size).noalias() -= W_run.transpose() * w_b;
    }
    SubtractGram(W, equations.runs, S);
  }
  S->triangularView<Eigen::StrictlyLower>() = S->transpose();
}

NormalEquations::LandmarkVector NormalEquations::LandmarkStep(int index,
                                                              const Eigen::VectorXd& dense_step,
                                                              double damping) const {
  const LandmarkEquations& equations = landmarks_[index];
  LandmarkVector right = -equations.b_l;
  for (const ColumnRun& run : equations.runs) {
    right.noalias() -=
        equations.H_ld.middleCols(run.local, run.size) * dense_step.segment(run.dense, run.size);
  }
  return Factor(equations.H_ll, damping).solve(right);
}

Eigen::MatrixXd NormalEquations::Covariance(const std::vector<BlockId>& ids) const {
  Eigen::MatrixXd S;
  Eigen::VectorXd g;
  Reduce(0, &S, &g);
  const ScaledCholesky factors(S);
  if (!factors.success()) return {};

  std::vector<int> rows;
  for (const BlockId& id : ids) {
    const int variable = problem_.Find(id);
    const int size = problem_.variables()[variable].type().tangent_size;
    for (int i = 0; i < size; ++i) rows.push_back(dense_offset_[variable] + i);
  }
  return factors.InverseBlock(rows);
}

}  // namespace plm_vins

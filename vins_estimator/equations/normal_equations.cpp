// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/normal_equations.h"

#include <stdexcept>

#include "vins_estimator/equations/marginalization_prior.h"
#include "vins_estimator/equations/term_evaluation.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {
namespace {

// Most terms are observations: two rows, and poses as variables. Loops of fixed length pay off for
// them.
constexpr int kViewRows = 2;
constexpr int kAnySize = 0;

// Columns of a row-major matrix.
struct Columns {
  const double* data;
  int size;
  int stride;
};

// Returns the tangent-space Jacobian of a term with respect to one of its variables.
Columns JacobianOf(const TermEvaluation& evaluation, const Slot& slot) {
  return {evaluation.jacobians[slot.block].data(), slot.size, slot.stride};
}

// Plain loops instead of Eigen's products, which take a compiler seconds for each pair of sizes.
template <int kRows, int kSize>
void AddProductOf(const Columns& left, const Columns& right, int any_rows, double* __restrict__ sum,
                  Eigen::Index sum_stride) {
  const int rows = kRows == kAnySize ? any_rows : kRows;
  const int size = kSize == kAnySize ? left.size : kSize;
  for (int j = 0; j < right.size; ++j, sum += sum_stride) {
    for (int i = 0; i < size; ++i) {
      double product = left.data[i] * right.data[j];
      for (int k = 1; k < rows; ++k) {
        product += left.data[k * left.stride + i] * right.data[k * right.stride + j];
      }
      sum[i] += product;
    }
  }
}

// Adds left^T right to a column-major matrix.
void AddProduct(const Columns& left, const Columns& right, int rows, double* sum,
                Eigen::Index sum_stride) {
  if (rows == kViewRows && left.size == kPoseTangentSize) {
    return AddProductOf<kViewRows, kPoseTangentSize>(left, right, rows, sum, sum_stride);
  }
  if (rows == kViewRows) {
    return AddProductOf<kViewRows, kAnySize>(left, right, rows, sum, sum_stride);
  }
  AddProductOf<kAnySize, kAnySize>(left, right, rows, sum, sum_stride);
}

// Adds a term to the dense equations: to the upper triangle of H, and to b.
void AddToDense(const TermLayout& layout, const TermEvaluation& evaluation, Eigen::MatrixXd* H,
                Eigen::VectorXd* b) {
  const int rows = evaluation.rows;
  const Columns residual = {evaluation.residual.data(), 1, 1};
  for (const Slot& slot : layout) {
    const Columns right = JacobianOf(evaluation, slot);
    for (const Slot* left = layout.begin(); left <= &slot; ++left) {
      AddProduct(JacobianOf(evaluation, *left), right, rows,
                 &(*H)(left->dense_offset, slot.dense_offset), H->outerStride());
    }
    AddProduct(right, residual, rows, &(*b)[slot.dense_offset], slot.size);
  }
}

// Adds a term to the equations of its landmark.
void AddToLandmark(const TermLayout& layout, const TermEvaluation& evaluation,
                   LandmarkEquations* equations) {
  const int rows = evaluation.rows;
  const Columns residual = {evaluation.residual.data(), 1, 1};
  const Columns own = {evaluation.jacobians[layout.landmark_block].data(),
                       static_cast<int>(equations->b_l.size()), layout.landmark_stride};
  for (const Slot& slot : layout) {  // H_ld is row-major: its transpose is column-major
    AddProduct(JacobianOf(evaluation, slot), own, rows, equations->H_ld.data() + slot.local_offset,
               equations->H_ld.outerStride());
  }
  AddProduct(own, own, rows, equations->H_ll.data(), equations->H_ll.outerStride());
  AddProduct(own, residual, rows, equations->b_l.data(), own.size);
}

}  // namespace

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

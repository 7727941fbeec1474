// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/landmark_equations.h"

#include <Eigen/Cholesky>
#include <utility>

namespace plm_vins {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Keeps the equations of an unobserved landmark solvable; far below any real information.
constexpr double kMinLandmarkInformation = 1e-9;

// The damped H_ll as L L^T.
Eigen::LLT<LandmarkMatrix> Factor(const LandmarkMatrix& H_ll, double damping) {
  LandmarkMatrix H = H_ll;
  H.diagonal() *= 1.0 + damping;
  H.diagonal().array() += kMinLandmarkInformation;
  return Eigen::LLT<LandmarkMatrix>(H);
}

// S -= W^T W, upper triangle, for W of kRows rows whose columns belong to `runs` of columns of S.
template <int kRows>
void SubtractGramOfRows(const RowMajorMatrix& W, const std::vector<ColumnRun>& runs,
                        Eigen::MatrixXd* S) {
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

void SubtractGram(const RowMajorMatrix& W, const std::vector<ColumnRun>& runs, Eigen::MatrixXd* S) {
  switch (W.rows()) {
    case 1:
      return SubtractGramOfRows<1>(W, runs, S);
    case 2:
      return SubtractGramOfRows<2>(W, runs, S);
    case 3:
      return SubtractGramOfRows<3>(W, runs, S);
    default:
      return SubtractGramOfRows<kMaxLandmarkSize>(W, runs, S);
  }
}

}  // namespace

LandmarkEquations::LandmarkEquations(int size, LandmarkLayout layout)
    : runs(std::move(layout.runs)), H_ll(size, size), b_l(size), H_ld(size, layout.columns) {}

void LandmarkEquations::SetZero() {
  H_ll.setZero();
  b_l.setZero();
  H_ld.setZero();
}

void EliminateLandmarks(const std::vector<LandmarkEquations>& landmarks, double damping,
                        Eigen::MatrixXd* S, Eigen::VectorXd* g) {
  RowMajorMatrix W;
  for (const LandmarkEquations& equations : landmarks) {
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
}

LandmarkVector SolveLandmark(const LandmarkEquations& equations, const Eigen::VectorXd& dense_step,
                             double damping) {
  LandmarkVector right = -equations.b_l;
  for (const ColumnRun& run : equations.runs) {
    right.noalias() -=
        equations.H_ld.middleCols(run.local, run.size) * dense_step.segment(run.dense, run.size);
  }
  return Factor(equations.H_ll, damping).solve(right);
}

}  // namespace plm_vins

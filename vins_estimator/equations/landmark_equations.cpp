// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/landmark_equations.h"

#include "common/geometry/small_cholesky.h"
#include "vins_estimator/equations/gram.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/geometry/point_in_host.h"

namespace plm_vins {
namespace {

// Keeps the equations of a degenerate landmark solvable; far below any real information.
constexpr double kMinLandmarkInformation = 1e-9;

// Returns the Cholesky factor of the damped H_ll, in the lower triangle.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> DampedFactor(const LandmarkMatrix& H_ll, double damping) {
  Eigen::Matrix<double, kSize, kSize> H = H_ll;
  H.diagonal() *= 1.0 + damping;
  H.diagonal().array() += kMinLandmarkInformation;
  FactorizeCholesky(&H);
  return H;
}

// Replaces W by L^-1 W.
template <int kSize>
void SolveRows(const Eigen::Matrix<double, kSize, kSize>& L, Eigen::Index columns, double* W) {
  for (int j = 0; j < kSize; ++j) {
    double* __restrict__ row = W + j * columns;
    for (int k = 0; k < j; ++k) {
      for (Eigen::Index i = 0; i < columns; ++i) row[i] -= L(j, k) * W[k * columns + i];
    }
    const double inverse = 1 / L(j, j);
    for (Eigen::Index i = 0; i < columns; ++i) row[i] *= inverse;
  }
}

// Eliminates one landmark of kSize parameters. `memory` is workspace for its H_ld.
template <int kSize>
void Eliminate(const LandmarkEquations& equations, double damping, double* memory,
               Eigen::MatrixXd* S, Eigen::VectorXd* g) {
  // H_dl H_ll^-1 H_ld = W^T W with W = L^-1 H_ld.
  const auto L = DampedFactor<kSize>(equations.H_ll, damping);
  Eigen::Map<Rows<kSize>> W(memory, kSize, equations.H_ld.cols());
  W = equations.H_ld;
  SolveRows(L, W.cols(), memory);
  const Eigen::Matrix<double, kSize, 1> w_b =
      L.template triangularView<Eigen::Lower>().solve(equations.b_l.template head<kSize>());
  for (const ColumnRun& run : equations.runs) {
    const auto W_run = W.middleCols(run.local, run.size);
    g->segment(run.dense, run.size).noalias() -= W_run.transpose() * w_b;
  }
  SubtractGram(W, equations.runs, S);
}

}  // namespace

LandmarkEquations::LandmarkEquations(int size, const std::vector<ColumnRun>& columns,
                                     double* memory)
    : runs(columns), H_ll(size, size), b_l(size), H_ld(memory, size, CountColumns(columns)) {}

void LandmarkEquations::SetZero() {
  H_ll.setZero();
  b_l.setZero();
  H_ld.setZero();
}

void EliminateLandmarks(const std::vector<LandmarkEquations>& landmarks, double damping,
                        Eigen::MatrixXd* S, Eigen::VectorXd* g) {
  Eigen::VectorXd memory(kMaxLandmarkSize * S->cols());
  for (const LandmarkEquations& equations : landmarks) {
    if (equations.b_l.size() == kPointSize) {
      Eliminate<kPointSize>(equations, damping, memory.data(), S, g);
    } else {
      Eliminate<kLineTangentSize>(equations, damping, memory.data(), S, g);
    }
  }
}

LandmarkVector SolveLandmark(const LandmarkEquations& equations, const Eigen::VectorXd& dense_step,
                             double damping) {
  LandmarkVector right = -equations.b_l;
  for (const ColumnRun& run : equations.runs) {
    right.noalias() -=
        equations.H_ld.middleCols(run.local, run.size) * dense_step.segment(run.dense, run.size);
  }
  if (right.size() == kPointSize) {
    return SolveByCholesky(DampedFactor<kPointSize>(equations.H_ll, damping), right);
  }
  return SolveByCholesky(DampedFactor<kLineTangentSize>(equations.H_ll, damping), right);
}

}  // namespace plm_vins

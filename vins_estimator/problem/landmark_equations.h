// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vins_estimator/problem/column_runs.h"

namespace plm_vins {

constexpr int kMaxLandmarkSize = 4;
using LandmarkMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxLandmarkSize, kMaxLandmarkSize>;
using LandmarkVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxLandmarkSize, 1>;

// One landmark's share of the equations, over the dense columns that its terms touch.
struct LandmarkEquations {
  // Over the columns of these runs, which must outlive it, with H_ld in `memory`.
  LandmarkEquations(int size, const std::vector<ColumnRun>& columns, double* memory);

  void SetZero();

  const std::vector<ColumnRun>& runs;  // of H_ld's columns
  LandmarkMatrix H_ll;
  LandmarkVector b_l;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> H_ld;
};

// Takes all landmarks out of the dense equations S step_d = -g (Schur complement): S upper
// triangle. The diagonals of all H_ll are scaled by 1 + `damping` before.
void EliminateLandmarks(const std::vector<LandmarkEquations>& landmarks, double damping,
                        Eigen::MatrixXd* S, Eigen::VectorXd* g);

// The step of a landmark that belongs to a dense step, with the same damping.
LandmarkVector SolveLandmark(const LandmarkEquations& equations, const Eigen::VectorXd& dense_step,
                             double damping);

}  // namespace plm_vins

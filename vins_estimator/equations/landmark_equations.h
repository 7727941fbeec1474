// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vins_estimator/equations/gram.h"

namespace plm_vins {

constexpr int kMaxLandmarkSize = 4;
using LandmarkMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxLandmarkSize, kMaxLandmarkSize>;
using LandmarkVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxLandmarkSize, 1>;

// Normal equations of one landmark, over the dense columns that its terms use.
struct LandmarkEquations {
  // `columns` and `memory`, which stores H_ld, must outlive this object.
  LandmarkEquations(int size, const std::vector<ColumnRun>& columns, double* memory);

  void SetZero();

  const std::vector<ColumnRun>& runs;  // columns of H_ld
  LandmarkMatrix H_ll;
  LandmarkVector b_l;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> H_ld;
};

// Eliminates all landmarks from the dense equations S step_d = -g (Schur complement; S is an upper
// triangle). The diagonals of all H_ll are scaled by 1 + `damping` before.
void EliminateLandmarks(const std::vector<LandmarkEquations>& landmarks, double damping,
                        Eigen::MatrixXd* S, Eigen::VectorXd* g);

// Returns the landmark's step for a given dense step, with the same damping (back substitution).
LandmarkVector SolveLandmark(const LandmarkEquations& equations, const Eigen::VectorXd& dense_step,
                             double damping);

}  // namespace plm_vins

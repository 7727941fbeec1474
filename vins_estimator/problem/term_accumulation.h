// SPDX-License-Identifier: BSD-3-Clause
// How one term adds to the equations: J^T J and J^T r, where its variables are.
#pragma once

#include <Eigen/Core>
#include <array>

#include "vins_estimator/problem/equation_layout.h"
#include "vins_estimator/problem/landmark_equations.h"
#include "vins_estimator/problem/term_evaluation.h"

namespace plm_vins {

// The dense columns of a term's Jacobian, packed column by column, and where they belong.
struct PackedJacobian {
  static constexpr int kMaxColumns = ResidualTerm::kMaxVariables * kMaxTangentSize;

  PackedJacobian(const TermLayout& layout, const TermEvaluation& evaluation);

  int columns = 0;
  std::array<double, kMaxColumns * TermEvaluation::kMaxRows> values;
  std::array<int, kMaxColumns> dense_column;
  std::array<int, kMaxColumns> local_column;
};

// Adds to the dense equations: to the upper triangle of H, and to b.
void AddToDense(const PackedJacobian& J, const TermEvaluation& evaluation, Eigen::MatrixXd* H,
                Eigen::VectorXd* b);

// Adds to the equations of the term's landmark.
void AddToLandmark(const TermLayout& layout, const PackedJacobian& J,
                   const TermEvaluation& evaluation, LandmarkEquations* equations);

}  // namespace plm_vins

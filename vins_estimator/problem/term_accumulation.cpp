// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/term_accumulation.h"

namespace plm_vins {
namespace {

inline double Dot(const double* a, const double* b, int rows) {
  double sum = 0;
  for (int i = 0; i < rows; ++i) sum += a[i] * b[i];
  return sum;
}

// Two rows, as corners have, are worth their own code: most of the terms are corners.
template <int kRows>
void AddRowsToDense(const PackedJacobian& J, const double* residual, int dynamic_rows,
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

}  // namespace

PackedJacobian::PackedJacobian(const TermLayout& layout, const TermEvaluation& evaluation) {
  const int rows = evaluation.rows;
  for (const Slot& slot : layout) {
    const double* block = evaluation.jacobians[slot.block].data();
    for (int c = 0; c < slot.size; ++c, ++columns) {
      double* column = &values[columns * rows];
      for (int r = 0; r < rows; ++r) column[r] = block[r * slot.stride + c];
      dense_column[columns] = slot.dense_offset + c;
      local_column[columns] = slot.local_offset + c;
    }
  }
}

void AddToDense(const PackedJacobian& J, const TermEvaluation& evaluation, Eigen::MatrixXd* H,
                Eigen::VectorXd* b) {
  const double* residual = evaluation.residual.data();
  if (evaluation.rows == 2) {
    AddRowsToDense<2>(J, residual, 2, H, b);
  } else {
    AddRowsToDense<0>(J, residual, evaluation.rows, H, b);
  }
}

void AddToLandmark(const TermLayout& layout, const PackedJacobian& J,
                   const TermEvaluation& evaluation, LandmarkEquations* equations) {
  const int rows = evaluation.rows;
  const int stride = layout.landmark_stride;
  const double* block = evaluation.jacobians[layout.landmark_block].data();
  const int size = static_cast<int>(equations->b_l.size());
  for (int l = 0; l < size; ++l) {
    std::array<double, TermEvaluation::kMaxRows> column;
    for (int r = 0; r < rows; ++r) column[r] = block[r * stride + l];
    for (int k = 0; k < size; ++k) {
      for (int r = 0; r < rows; ++r) equations->H_ll(l, k) += column[r] * block[r * stride + k];
    }
    for (int j = 0; j < J.columns; ++j) {
      equations->H_ld(l, J.local_column[j]) += Dot(column.data(), &J.values[j * rows], rows);
    }
    equations->b_l[l] += Dot(column.data(), evaluation.residual.data(), rows);
  }
}

}  // namespace plm_vins

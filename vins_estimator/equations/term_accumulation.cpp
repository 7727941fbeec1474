// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/term_accumulation.h"

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

}  // namespace

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

}  // namespace plm_vins

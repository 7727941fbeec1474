// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/term_accumulation.h"

#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/geometry/point_in_host.h"

namespace plm_vins {
namespace {

// Most terms are views: two rows, by poses and by a landmark. They are worth products of fixed
// size.
constexpr int kViewRows = 2;
constexpr int kPoseSize = 6;

// The Jacobian of a term by one of its variables, in the tangent space.
template <int kRows = Eigen::Dynamic, int kColumns = Eigen::Dynamic>
auto BlockOf(const TermEvaluation& evaluation, int block, int size, int stride) {
  using Matrix = Eigen::Matrix<double, kRows, kColumns, Eigen::RowMajor>;
  return Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>(
      evaluation.jacobians[block].data(), evaluation.rows, size, Eigen::OuterStride<>(stride));
}

template <int kRows = Eigen::Dynamic, int kColumns = Eigen::Dynamic>
auto BlockOf(const TermEvaluation& evaluation, const Slot& slot) {
  return BlockOf<kRows, kColumns>(evaluation, slot.block, slot.size, slot.stride);
}

Eigen::Map<const Eigen::VectorXd> ResidualOf(const TermEvaluation& evaluation) {
  return Eigen::Map<const Eigen::VectorXd>(evaluation.residual.data(), evaluation.rows);
}

void AddPair(const TermEvaluation& evaluation, const Slot& left, const Slot& right,
             Eigen::MatrixXd* H) {
  if (evaluation.rows == kViewRows && left.size == kPoseSize && right.size == kPoseSize) {
    H->block<kPoseSize, kPoseSize>(left.dense_offset, right.dense_offset) +=
        BlockOf<kViewRows, kPoseSize>(evaluation, left)
            .transpose()
            .lazyProduct(BlockOf<kViewRows, kPoseSize>(evaluation, right));
  } else {
    H->block(left.dense_offset, right.dense_offset, left.size, right.size).noalias() +=
        BlockOf(evaluation, left).transpose().lazyProduct(BlockOf(evaluation, right));
  }
}

template <int kSize>
void AddView(const TermLayout& layout, const TermEvaluation& evaluation,
             LandmarkEquations* equations) {
  const auto J_l =
      BlockOf<kViewRows, kSize>(evaluation, layout.landmark_block, kSize, layout.landmark_stride);
  for (const Slot& slot : layout) {
    if (slot.size == kPoseSize) {
      equations->H_ld.block<kSize, kPoseSize>(0, slot.local_offset) +=
          J_l.transpose().lazyProduct(BlockOf<kViewRows, kPoseSize>(evaluation, slot));
    } else {
      equations->H_ld.block(0, slot.local_offset, kSize, slot.size) +=
          J_l.transpose().lazyProduct(BlockOf(evaluation, slot));
    }
  }
  equations->H_ll.topLeftCorner<kSize, kSize>() += J_l.transpose().lazyProduct(J_l);
  equations->b_l.head<kSize>() += J_l.transpose().lazyProduct(ResidualOf(evaluation));
}

}  // namespace

void AddToDense(const TermLayout& layout, const TermEvaluation& evaluation, Eigen::MatrixXd* H,
                Eigen::VectorXd* b) {
  for (const Slot& right : layout) {
    for (const Slot* left = layout.begin(); left <= &right; ++left) {
      AddPair(evaluation, *left, right, H);
    }
    b->segment(right.dense_offset, right.size) +=
        BlockOf(evaluation, right).transpose().lazyProduct(ResidualOf(evaluation));
  }
}

void AddToLandmark(const TermLayout& layout, const TermEvaluation& evaluation,
                   LandmarkEquations* equations) {
  const auto size = equations->b_l.size();
  if (evaluation.rows == kViewRows && size == kPointSize) {
    return AddView<kPointSize>(layout, evaluation, equations);
  }
  if (evaluation.rows == kViewRows && size == kLineTangentSize) {
    return AddView<kLineTangentSize>(layout, evaluation, equations);
  }
  const auto J_l =
      BlockOf(evaluation, layout.landmark_block, static_cast<int>(size), layout.landmark_stride);
  for (const Slot& slot : layout) {
    equations->H_ld.middleCols(slot.local_offset, slot.size).noalias() +=
        J_l.transpose().lazyProduct(BlockOf(evaluation, slot));
  }
  equations->H_ll.noalias() += J_l.transpose().lazyProduct(J_l);
  equations->b_l.noalias() += J_l.transpose().lazyProduct(ResidualOf(evaluation));
}

}  // namespace plm_vins

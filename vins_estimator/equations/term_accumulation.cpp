// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/term_accumulation.h"

#include <type_traits>

#include "common/camera/camera_model.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/geometry/point_in_host.h"

namespace plm_vins {
namespace {

// Most terms are observations: two rows, with poses, a landmark and possibly intrinsics as
// variables. Matrix products of fixed size pay off for them.
constexpr int kViewRows = 2;

template <int kSize>
using Size = std::integral_constant<int, kSize>;

// Calls `body` with the size as a constant if it is a common one, otherwise with Eigen::Dynamic.
template <typename Body>
void WithFixed(int size, const Body& body) {
  if (size == kPoseTangentSize) return body(Size<kPoseTangentSize>());
  if (size == kIntrinsicsSize) return body(Size<kIntrinsicsSize>());
  body(Size<Eigen::Dynamic>());
}

// Returns the tangent-space Jacobian of a term with respect to one of its variables.
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
  H->block(left.dense_offset, right.dense_offset, left.size, right.size).noalias() +=
      BlockOf(evaluation, left).transpose().lazyProduct(BlockOf(evaluation, right));
}

void AddPairOfView(const TermEvaluation& evaluation, const Slot& left, const Slot& right,
                   Eigen::MatrixXd* H) {
  WithFixed(left.size, [&](auto left_size) {
    WithFixed(right.size, [&](auto right_size) {
      H->block<left_size, right_size>(left.dense_offset, right.dense_offset, left.size,
                                      right.size) +=
          BlockOf<kViewRows, left_size>(evaluation, left)
              .transpose()
              .lazyProduct(BlockOf<kViewRows, right_size>(evaluation, right));
    });
  });
}

template <int kSize>
void AddView(const TermLayout& layout, const TermEvaluation& evaluation,
             LandmarkEquations* equations) {
  const auto J_l =
      BlockOf<kViewRows, kSize>(evaluation, layout.landmark_block, kSize, layout.landmark_stride);
  for (const Slot& slot : layout) {
    WithFixed(slot.size, [&](auto size) {
      equations->H_ld.block<kSize, size>(0, slot.local_offset, kSize, slot.size) +=
          J_l.transpose().lazyProduct(BlockOf<kViewRows, size>(evaluation, slot));
    });
  }
  equations->H_ll.topLeftCorner<kSize, kSize>() += J_l.transpose().lazyProduct(J_l);
  equations->b_l.head<kSize>() += J_l.transpose().lazyProduct(ResidualOf(evaluation));
}

}  // namespace

void AddToDense(const TermLayout& layout, const TermEvaluation& evaluation, Eigen::MatrixXd* H,
                Eigen::VectorXd* b) {
  for (const Slot& right : layout) {
    for (const Slot* left = layout.begin(); left <= &right; ++left) {
      if (evaluation.rows == kViewRows) {
        AddPairOfView(evaluation, *left, right, H);
      } else {
        AddPair(evaluation, *left, right, H);
      }
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

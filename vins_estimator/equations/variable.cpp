// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/variable.h"

#include <algorithm>

#include "common/camera/camera_model.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/geometry/depth_stream.h"
#include "vins_estimator/geometry/plucker.h"

namespace plm_vins {
namespace {

template <int kSize>
void VectorPlus(const double* x, const double* delta, double* x_plus_delta) {
  for (int i = 0; i < kSize; ++i) x_plus_delta[i] = x[i] + delta[i];
}

template <int kSize>
void VectorMinus(const double* y, const double* x, double* y_minus_x) {
  for (int i = 0; i < kSize; ++i) y_minus_x[i] = y[i] - x[i];
}

// Keeps the inverse depth positive, so that a point stays in front of its host: steps to or beyond
// infinity are clipped at a large depth, or at the current one if that is larger.
void PointPlus(const double* x, const double* delta, double* x_plus_delta) {
  constexpr double kFarInverseDepth = 1e-3;  // [1/m]
  const double least = std::min(x[2], kFarInverseDepth);
  VectorPlus<3>(x, delta, x_plus_delta);
  x_plus_delta[2] = std::max(x_plus_delta[2], least);
}

// Keeps focal lengths positive.
void IntrinsicsPlus(const double* x, const double* delta, double* x_plus_delta) {
  constexpr double kMinFocalLength = 1;  // [px]
  VectorPlus<kIntrinsicsSize>(x, delta, x_plus_delta);
  for (int i = 0; i < 2; ++i) x_plus_delta[i] = std::max(x_plus_delta[i], kMinFocalLength);
}

template <int kSize>
VariableType VectorVariable() {
  return {kSize, kSize, &VectorPlus<kSize>, &VectorMinus<kSize>};
}

}  // namespace

const VariableType& PoseVariable() {
  static const VariableType type{kPoseSize, kPoseTangentSize, &PosePlus, &PoseMinus};
  return type;
}

const VariableType& MotionVariable() {
  static const VariableType type = VectorVariable<9>();
  return type;
}

const VariableType& ScalarVariable() {
  static const VariableType type = VectorVariable<1>();
  return type;
}

const VariableType& PointVariable() {
  static const VariableType type{3, 3, &PointPlus, &VectorMinus<3>};
  return type;
}

const VariableType& IntrinsicsVariable() {
  static const VariableType type{kIntrinsicsSize, kIntrinsicsSize, &IntrinsicsPlus,
                                 &VectorMinus<kIntrinsicsSize>};
  return type;
}

const VariableType& DepthStreamVariable() {
  static const VariableType type = VectorVariable<kDepthStreamSize>();
  return type;
}

const VariableType& LineVariable() {
  static const VariableType type{kLineSize, kLineTangentSize, &LinePlus, &LineMinus};
  return type;
}

const VariableType& VariableTypeOf(BlockKind kind) {
  switch (kind) {
    case BlockKind::kPose:
    case BlockKind::kExtrinsic:
      return PoseVariable();
    case BlockKind::kMotion:
      return MotionVariable();
    case BlockKind::kPoint:
      return PointVariable();
    case BlockKind::kLine:
      return LineVariable();
    case BlockKind::kIntrinsics:
      return IntrinsicsVariable();
    case BlockKind::kDepthStream:
      return DepthStreamVariable();
    default:
      return ScalarVariable();
  }
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/equations/block_id.h"

namespace plm_vins {

using PlusFunction = void (*)(const double* x, const double* delta, double* x_plus_delta);
using MinusFunction = void (*)(const double* y, const double* x, double* y_minus_x);

// Manifold of a variable: sizes, and the retraction by a tangent vector with its inverse.
struct VariableType {
  int ambient_size = 0;
  int tangent_size = 0;
  PlusFunction plus = nullptr;
  MinusFunction minus = nullptr;
};

constexpr int kMaxAmbientSize = 9;

const VariableType& PoseVariable();    // 7 -> 6: poses of frames, extrinsics of cameras
const VariableType& MotionVariable();  // 9, vector space
const VariableType& ScalarVariable();  // 1, vector space: time offset
// 3, vector space: image point and inverse depth in the host; the inverse depth stays positive.
const VariableType& PointVariable();
// 8, vector space: camera intrinsics; focal lengths stay positive.
const VariableType& IntrinsicsVariable();
// 2, vector space: scale and delay of a depth stream (geometry/depth_stream.h).
const VariableType& DepthStreamVariable();
const VariableType& LineVariable();  // 5 -> 4: orthonormal representation (geometry/plucker.h)

const VariableType& VariableTypeOf(BlockKind kind);

// A variable of an optimization problem. The values are owned by the caller.
struct Variable {
  BlockId id;
  double* values = nullptr;
  bool constant = false;
  // Linearization point (first-estimate Jacobians, [Huang2010]); null: the current values.
  const double* linearization = nullptr;

  const VariableType& type() const { return VariableTypeOf(id.kind); }
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/problem/block_id.h"

namespace plm_vins {

using PlusFunction = void (*)(const double* x, const double* delta, double* x_plus_delta);
using MinusFunction = void (*)(const double* y, const double* x, double* y_minus_x);

// How a variable's values change by a tangent vector.
struct VariableType {
  int ambient_size = 0;
  int tangent_size = 0;
  PlusFunction plus = nullptr;
  MinusFunction minus = nullptr;
};

constexpr int kMaxAmbientSize = 9;

const VariableType& PoseVariable();    // 7 -> 6
const VariableType& MotionVariable();  // 9, vector space
const VariableType& ScalarVariable();  // 1, vector space: time offset, read-out time
// 3, vector space: image point and inverse depth in a host, which stays positive.
const VariableType& PointVariable();
// 8, vector space: of the camera; focal lengths stay positive.
const VariableType& IntrinsicsVariable();
const VariableType& LineVariable();  // 5 -> 4: orthonormal representation (geometry/plucker.h)

const VariableType& VariableTypeOf(BlockKind kind);

// One variable of an optimisation problem. The values belong to the caller.
struct Variable {
  BlockId id;
  double* values = nullptr;
  bool constant = false;
  // Where Jacobians are taken (first-estimate Jacobians, [Huang2010]); null: at the current values.
  const double* linearization = nullptr;

  const VariableType& type() const { return VariableTypeOf(id.kind); }
};

}  // namespace plm_vins

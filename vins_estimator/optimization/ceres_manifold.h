// SPDX-License-Identifier: BSD-3-Clause
// The one place that knows Ceres' two interfaces for manifolds: Manifold (2.1 and later) and
// LocalParameterization (before).
#pragma once

#include <ceres/problem.h>
#include <ceres/version.h>

#if CERES_VERSION_MAJOR > 2 || (CERES_VERSION_MAJOR == 2 && CERES_VERSION_MINOR >= 1)
#define PLM_CERES_HAS_MANIFOLD 1
#include <ceres/manifold.h>
#else
#define PLM_CERES_HAS_MANIFOLD 0
#include <ceres/local_parameterization.h>
#endif

#include "vins_estimator/problem/variable.h"

namespace plm_vins {

// The manifold that variables of a type live on, as Ceres wants it. The Jacobians of the factors
// are tangent already (factors/manifolds.h), padded with zero columns: PlusJacobian() is [I; 0], so
// that Ceres' product of both is the tangent Jacobian itself.
#if PLM_CERES_HAS_MANIFOLD
class TangentManifold final : public ceres::Manifold {
 public:
  explicit TangentManifold(const VariableType& type) : type_(type) {}

  int AmbientSize() const override { return type_.ambient_size; }
  int TangentSize() const override { return type_.tangent_size; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;  // [I, 0]

 private:
  const VariableType type_;
};
#else
class TangentManifold final : public ceres::LocalParameterization {
 public:
  explicit TangentManifold(const VariableType& type) : type_(type) {}

  int GlobalSize() const override { return type_.ambient_size; }
  int LocalSize() const override { return type_.tangent_size; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool ComputeJacobian(const double* x, double* jacobian) const override;  // [I; 0]

 private:
  const VariableType type_;
};
#endif

// Declares `values`, a parameter block that `problem` has already, to be a variable of this type.
void SetManifold(ceres::Problem* problem, double* values, const VariableType& type);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
// Adapter to Ceres' two interfaces for manifolds: Manifold (since 2.1) and LocalParameterization
// (before).
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

#include "vins_estimator/equations/variable.h"

namespace plm_vins {

// Manifold of a variable type, in Ceres' interface. The factors' Jacobians are already with respect
// to the tangent (factors/manifolds.h) and padded with zero columns. PlusJacobian() is therefore
// [I; 0], so that Ceres' product of both is the tangent Jacobian itself.
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

// Sets the manifold of `values`, a parameter block of `problem`, to that of the variable type.
void SetManifold(ceres::Problem* problem, double* values, const VariableType& type);

}  // namespace plm_vins

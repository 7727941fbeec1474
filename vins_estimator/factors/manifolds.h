// SPDX-License-Identifier: BSD-3-Clause
// The manifold of poses, and the one place that knows Ceres' two interfaces for manifolds: Manifold
// (2.1 and later) and LocalParameterization (before).
//
// A pose is [p_W (3), q_W_B (x, y, z, w)], its tangent [dp (3), dtheta (3)]:
//   p <- p + dp,   q <- q Exp(dtheta)   (rotation perturbed on the right, in the body frame)
//
// Convention for every cost function of this project: the Jacobian with respect to a pose is the
// derivative by the tangent of Plus at zero, 6 columns, followed by one column of zeros. To match,
// PlusJacobian() is [I; 0], so that Ceres' product of both is the tangent Jacobian itself. The 7
// columns are *not* derivatives by the 7 numbers of the pose. The same holds for lines (5 -> 4).
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

namespace plm_vins {

constexpr int kPoseSize = 7;
constexpr int kPoseTangentSize = 6;

// x_plus_delta = x [+] delta. The quaternion of the result has unit length.
void PosePlus(const double* x, const double* delta, double* x_plus_delta);

// The delta with y = x [+] delta; its rotation is at most pi long.
void PoseMinus(const double* y, const double* x, double* y_minus_x);

using PlusFunction = void (*)(const double* x, const double* delta, double* x_plus_delta);
using MinusFunction = void (*)(const double* y, const double* x, double* y_minus_x);

// What Plus and Minus do, as Ceres wants it.
#if PLM_CERES_HAS_MANIFOLD
class TangentManifold final : public ceres::Manifold {
 public:
  TangentManifold(int ambient_size, int tangent_size, PlusFunction plus, MinusFunction minus)
      : ambient_size_(ambient_size), tangent_size_(tangent_size), plus_(plus), minus_(minus) {}

  int AmbientSize() const override { return ambient_size_; }
  int TangentSize() const override { return tangent_size_; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;  // [I; 0], see above
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;  // [I, 0]

 private:
  int ambient_size_, tangent_size_;
  PlusFunction plus_;
  MinusFunction minus_;
};
#else
class TangentManifold final : public ceres::LocalParameterization {
 public:
  // There is no Minus in this interface.
  TangentManifold(int ambient_size, int tangent_size, PlusFunction plus, MinusFunction /*minus*/)
      : ambient_size_(ambient_size), tangent_size_(tangent_size), plus_(plus) {}

  int GlobalSize() const override { return ambient_size_; }
  int LocalSize() const override { return tangent_size_; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool ComputeJacobian(const double* x, double* jacobian) const override;  // [I; 0], see above

 private:
  int ambient_size_, tangent_size_;
  PlusFunction plus_;
};
#endif

// Declares `values`, a parameter block that `problem` has already, to live on a manifold.
void SetManifold(ceres::Problem* problem, double* values, const TangentManifold& manifold);

}  // namespace plm_vins

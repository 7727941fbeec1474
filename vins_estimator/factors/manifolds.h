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
// columns are *not* derivatives by the 7 numbers of the pose.
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

#if PLM_CERES_HAS_MANIFOLD
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return kPoseSize; }
  int TangentSize() const override { return kPoseTangentSize; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;  // [I; 0], see above
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;  // [I, 0]
};
#else
class PoseManifold final : public ceres::LocalParameterization {
 public:
  int GlobalSize() const override { return kPoseSize; }
  int LocalSize() const override { return kPoseTangentSize; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool ComputeJacobian(const double* x, double* jacobian) const override;  // [I; 0], see above
};
#endif

// Declares `pose`, a parameter block that `problem` has already, to live on the manifold.
void SetPoseManifold(ceres::Problem* problem, double* pose);

}  // namespace plm_vins

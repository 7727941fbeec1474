// SPDX-License-Identifier: BSD-3-Clause
// The manifolds of poses and of a second camera's mounting.
//
// A pose is [p_W (3), q_W_B (x, y, z, w)], its tangent [dp (3), dtheta (3)]:
//   p <- p + dp,   q <- q Exp(dtheta)   (rotation perturbed on the right, in the body frame)
//
// Convention for every factor of this project: the Jacobian with respect to a pose is the
// derivative with respect to the tangent of Plus at zero, 6 columns, followed by one column of
// zeros. Its 7 columns are *not* derivatives with respect to the 7 numbers of the pose. The same
// holds for lines (5 -> 4) and for mountings (7 -> 6).
#pragma once

#include <Eigen/Core>

namespace plm_vins {

constexpr int kPoseSize = 7;
constexpr int kPoseTangentSize = 6;

// Computes x_plus_delta = x [+] delta. The resulting quaternion has unit norm.
void PosePlus(const double* x, const double* delta, double* x_plus_delta);

// Computes delta such that y = x [+] delta; its rotation angle is at most pi.
void PoseMinus(const double* y, const double* x, double* y_minus_x);

// A mounting is the pose of the second camera in the first, T_C_C1, whose baseline is given by its
// direction and the logarithm of its length: images alone cannot distinguish the latter from the
// scale of the world. It is [t_C_C1 (3), q_C_C1 (x, y, z, w)], its tangent [direction (2), length
// (1), dtheta (3)]:
//   t <- exp(length) Exp(B(t) direction) t,   q <- q Exp(dtheta),   B(t) = TangentBasis(t / |t|).
void MountingPlus(const double* x, const double* delta, double* x_plus_delta);
void MountingMinus(const double* y, const double* x, double* y_minus_x);

// Returns the derivative of the baseline [m] by [direction, length] at zero.
Eigen::Matrix3d BaselineByTangent(const Eigen::Vector3d& baseline);

}  // namespace plm_vins

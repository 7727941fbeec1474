// SPDX-License-Identifier: BSD-3-Clause
// The manifold of poses.
//
// A pose is [p_W (3), q_W_B (x, y, z, w)], its tangent [dp (3), dtheta (3)]:
//   p <- p + dp,   q <- q Exp(dtheta)   (rotation perturbed on the right, in the body frame)
//
// Convention for every factor of this project: the Jacobian with respect to a pose is the
// derivative by the tangent of Plus at zero, 6 columns, followed by one column of zeros. The 7
// columns are *not* derivatives by the 7 numbers of the pose. The same holds for lines (5 -> 4).
#pragma once

namespace plm_vins {

constexpr int kPoseSize = 7;
constexpr int kPoseTangentSize = 6;

// x_plus_delta = x [+] delta. The quaternion of the result has unit length.
void PosePlus(const double* x, const double* delta, double* x_plus_delta);

// The delta with y = x [+] delta; its rotation is at most pi long.
void PoseMinus(const double* y, const double* x, double* y_minus_x);

}  // namespace plm_vins

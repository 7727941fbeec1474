// SPDX-License-Identifier: BSD-3-Clause
// The manifold of poses.
//
// A pose is [p_W (3), q_W_B (x, y, z, w)], its tangent [dp (3), dtheta (3)]:
//   p <- p + dp,   q <- q Exp(dtheta)   (rotation perturbed on the right, in the body frame)
//
// Convention for every factor of this project: the Jacobian with respect to a pose is the
// derivative with respect to the tangent of Plus at zero, 6 columns, followed by one column of
// zeros. Its 7 columns are *not* derivatives with respect to the 7 numbers of the pose. The same
// holds for lines (5 -> 4).
#pragma once

namespace plm_vins {

constexpr int kPoseSize = 7;
constexpr int kPoseTangentSize = 6;

// Computes x_plus_delta = x [+] delta. The resulting quaternion has unit norm.
void PosePlus(const double* x, const double* delta, double* x_plus_delta);

// Computes delta such that y = x [+] delta; its rotation angle is at most pi.
void PoseMinus(const double* y, const double* x, double* y_minus_x);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
// Lines in space: Plücker coordinates for computation, the orthonormal representation for
// optimization ([Bartoli2005], sections 2 and 4).
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// Plücker coordinates of a line: p x direction = moment for each of its points p. Both vectors
// share an arbitrary scale and are perpendicular; |moment| / |direction| is the distance from the
// origin. The moment is the normal of the plane through origin and line; for a camera at the origin
// it is the projected line, moment . (x, y, 1) = 0.
struct PluckerLine {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

// Returns the line through two points.
PluckerLine LineThrough(const Eigen::Vector3d& start, const Eigen::Vector3d& end);

// Returns the intersection line of the planes a . x = alpha and b . x = beta. Its direction is zero
// if they are parallel.
PluckerLine Intersection(const Eigen::Vector3d& a, double alpha, const Eigen::Vector3d& b,
                         double beta);

// Transforms a line from frame B to frame A.
PluckerLine operator*(const Rigid3d& T_A_B, const PluckerLine& line_B);

// Returns the point of the line nearest to the origin.
Eigen::Vector3d NearestToOrigin(const PluckerLine& line);

// Returns the intersection of the line with the plane `normal` . x = 0 through the origin; not
// finite if they are parallel.
Eigen::Vector3d PointInPlane(const PluckerLine& line, const Eigen::Vector3d& normal);

// Orthonormal representation, the solver's variable: [q (x, y, z, w), phi] with U = R(q),
//   moment = cos(phi) U e1,   direction = sin(phi) U e2,   0 < phi < pi.
// Its tangent is [dtheta (3), dphi]: q <- q Exp(dtheta), phi <- phi + dphi.
constexpr int kLineSize = 5;
constexpr int kLineTangentSize = 4;
using OrthonormalLine = std::array<double, kLineSize>;

// Throws std::invalid_argument for lines through the origin or without direction.
OrthonormalLine ToOrthonormal(const PluckerLine& line);
PluckerLine ToPlucker(const double* line);

void LinePlus(const double* x, const double* delta, double* x_plus_delta);
void LineMinus(const double* y, const double* x, double* y_minus_x);

// Derivatives of ToPlucker with respect to the tangent.
struct PluckerJacobian {
  Eigen::Matrix<double, 3, kLineTangentSize> d_moment;
  Eigen::Matrix<double, 3, kLineTangentSize> d_direction;
};
PluckerJacobian ToPluckerJacobian(const double* line);

}  // namespace plm_vins

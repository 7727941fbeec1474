// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

// What was measured between two nodes of the pose graph.
struct LevelEdge {
  int from = -1;
  int to = -1;
  LevelTransform T_from_to;
  Matrix4d covariance = Matrix4d::Identity();  // of (x, y, z, yaw) of T_from_to [m, rad]
  bool is_loop = false;
  double way = 0;  // of odometry that is in it, as far as it may have drifted [m]
};

// The same, told the other way round.
LevelEdge Reversed(const LevelEdge& edge);

// What two edges, a to b and b to c, say of a and c. They are taken for independent.
LevelEdge Chained(const LevelEdge& a_b, const LevelEdge& b_c);

// Covariance of the place of an edge's end in the map, where its beginning has this place and
// covariance there.
Matrix4d CovarianceInMap(const LevelTransform& T_M_from, const Matrix4d& covariance,
                         const LevelEdge& edge);

// Measured less actual T_from_to, as (x, y, z, yaw).
inline Vector4d EdgeError(const LevelTransform& measured, const LevelTransform& actual) {
  Vector4d error = measured.ToVector() - actual.ToVector();
  error(3) = WrapAngle(error(3));
  return error;
}

// W with W^T W = covariance^-1.
Matrix4d Whitening(const Matrix4d& covariance);

// The Mahalanobis distance of an error from zero [standard deviations].
double Deviations(const Vector4d& error, const Matrix4d& covariance);

// Of four variables of which nothing is wrong, the deviations stay below in 997 of 1000 cases: as
// those of one below three. [Wilson1931] gives chi-square; 16.3 is its square.
constexpr double kThreeSigmaOf4Dof = 4.03;

}  // namespace plm_vins

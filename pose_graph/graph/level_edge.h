// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

// A relative-pose measurement between two nodes of the pose graph.
struct LevelEdge {
  int from = -1;
  int to = -1;
  LevelTransform T_from_to;
  Matrix4d covariance = Matrix4d::Identity();  // covariance of T_from_to as (x, y, z, yaw) [m, rad]
  bool is_loop = false;
  double way = 0;  // odometry distance that the edge spans, over which it may have drifted [m]
};

// Returns the inverse measurement.
LevelEdge Reversed(const LevelEdge& edge);

// Composes the edges a to b and b to c, assuming that they are independent.
LevelEdge Chained(const LevelEdge& a_b, const LevelEdge& b_c);

// Covariance of the pose T_M_to in the map, given pose and covariance of the edge's start.
Matrix4d CovarianceInMap(const LevelTransform& T_M_from, const Matrix4d& covariance,
                         const LevelEdge& edge);

// Residual: measured minus actual T_from_to, as (x, y, z, yaw).
inline Vector4d EdgeError(const LevelTransform& measured, const LevelTransform& actual) {
  Vector4d error = measured.ToVector() - actual.ToVector();
  error(3) = WrapAngle(error(3));
  return error;
}

// Returns W with W^T W = covariance^-1.
Matrix4d Whitening(const Matrix4d& covariance);

// Mahalanobis distance of the residual [standard deviations].
double Deviations(const Vector4d& error, const Matrix4d& covariance);

// Bound of the Mahalanobis distance of four Gaussian variables, exceeded with the probability of 3
// sigma in one dimension (0.3 %). Its square, 16.3, is the chi-square quantile by [Wilson1931].
constexpr double kThreeSigmaOf4Dof = 4.03;

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph/level_edge.h"

#include <Eigen/Cholesky>

namespace plm_vins {
namespace {

// Derivative of Rz(yaw) u by yaw, for v = Rz(yaw) u.
Eigen::Vector3d Turning(const Eigen::Vector3d& v) { return Eigen::Vector3d::UnitZ().cross(v); }

}  // namespace

LevelEdge Reversed(const LevelEdge& edge) {
  LevelEdge result = edge;
  result.from = edge.to;
  result.to = edge.from;
  result.T_from_to = edge.T_from_to.Inverse();
  Matrix4d J = Matrix4d::Zero();
  J.topLeftCorner<3, 3>() = -edge.T_from_to.rotation().toRotationMatrix().transpose();
  J.topRightCorner<3, 1>() = -Turning(result.T_from_to.translation);
  J(3, 3) = -1;
  result.covariance = J * edge.covariance * J.transpose();
  return result;
}

LevelEdge Chained(const LevelEdge& a_b, const LevelEdge& b_c) {
  LevelEdge result;
  result.from = a_b.from;
  result.to = b_c.to;
  result.T_from_to = a_b.T_from_to * b_c.T_from_to;
  result.is_loop = a_b.is_loop || b_c.is_loop;
  result.way = a_b.way + b_c.way;
  const Eigen::Matrix3d R_a_b = a_b.T_from_to.rotation().toRotationMatrix();
  Matrix4d J_a_b = Matrix4d::Identity();
  J_a_b.topRightCorner<3, 1>() = Turning(R_a_b * b_c.T_from_to.translation);
  Matrix4d J_b_c = Matrix4d::Identity();
  J_b_c.topLeftCorner<3, 3>() = R_a_b;
  result.covariance =
      J_a_b * a_b.covariance * J_a_b.transpose() + J_b_c * b_c.covariance * J_b_c.transpose();
  return result;
}

Matrix4d CovarianceInMap(const LevelTransform& T_M_from, const Matrix4d& covariance,
                         const LevelEdge& edge) {
  LevelEdge map_from;
  map_from.T_from_to = T_M_from;
  map_from.covariance = covariance;
  return Chained(map_from, edge).covariance;
}

Matrix4d Whitening(const Matrix4d& covariance) {
  const Eigen::LLT<Matrix4d> factor(covariance);
  return factor.matrixL().solve(Matrix4d::Identity());
}

double Deviations(const Vector4d& error, const Matrix4d& covariance) {
  return (Whitening(covariance) * error).norm();
}

}  // namespace plm_vins

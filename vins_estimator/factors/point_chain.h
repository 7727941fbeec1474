// SPDX-License-Identifier: BSD-3-Clause
// Points along a CameraChain, and their derivatives.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry/so3.h"
#include "vins_estimator/factors/camera_chain.h"
#include "vins_estimator/geometry/point_in_host.h"

namespace plm_vins {

using PointChain = CameraChain<Eigen::Vector3d>;

// Derivative of a residual with kRows rows with respect to a point.
template <int kRows>
using PointDerivative = Eigen::Matrix<double, kRows, 3>;

inline Eigen::Vector3d ToParent(const PoseBlock& pose, const Eigen::Vector3d& p) {
  return pose.R * p + pose.p;
}
inline Eigen::Vector3d ToChild(const PoseBlock& pose, const Eigen::Vector3d& p) {
  return pose.R.transpose() * (p - pose.p);
}

template <int kRows>
PointDerivative<kRows> ByParent(const PoseBlock& pose, const PointDerivative<kRows>& by_child) {
  return by_child * pose.R.transpose();
}
template <int kRows>
PointDerivative<kRows> ByChild(const PoseBlock& pose, const PointDerivative<kRows>& by_parent) {
  return by_parent * pose.R;
}

template <int kRows>
void AddPoseDerivative(double sign, const PointDerivative<kRows>& by_child,
                       const Eigen::Vector3d& in_child, const PointDerivative<kRows>& by_parent,
                       const Eigen::Vector3d& /*in_parent*/, PoseDerivative<kRows>* sum) {
  sum->position += sign * by_parent;
  sum->rotation -= sign * by_child * Skew(in_child);
}

// Returns the derivative of weight * (x / z, y / z) with respect to the point.
inline PointDerivative<2> ProjectionJacobian(const Eigen::Vector3d& p_C, double weight) {
  const Eigen::Vector2d m = p_C.hnormalized();
  PointDerivative<2> J;
  J << 1, 0, -m.x(), 0, 1, -m.y();
  J *= weight / p_C.z();
  return J;
}

// Writes the Jacobian with respect to a point's coordinates, see PointInHost().
template <int kRows>
void SetPointJacobian(const PointDerivative<kRows>& by_host, const double* point, double* values) {
  const Eigen::Vector3d p_Ch = PointInHost(point);
  Eigen::Matrix3d d_p_d_point;
  d_p_d_point << 1, 0, -p_Ch.x(), 0, 1, -p_Ch.y(), 0, 0, -p_Ch.z();
  d_p_d_point /= point[2];
  Eigen::Map<Eigen::Matrix<double, kRows, 3, Eigen::RowMajor>> J(values);
  J = by_host * d_p_d_point;
}

}  // namespace plm_vins

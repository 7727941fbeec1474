// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry/so3.h"
#include "vins_estimator/factors/camera_chain.h"
#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/depth_stream.h"
#include "vins_estimator/geometry/point_in_host.h"
#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

// Points along a CameraChain, and their derivatives.

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

// Reprojection of a point into a camera that observes it:
//   r = weight * ( pi(T_Ct_Ch p_Ch) - m_t(td) )
// In the host itself, r = weight * ( (x, y) - m_h(td) ). Blocks: those of the chain T_Ct_Ch, time
// offset td (1), point (3). Jacobians follow factors/manifolds.h. Evaluate() fails if the point is
// behind the target camera.
class PointFactor final : public Factor {
 public:
  // `weight`: focal length over the standard deviation of a corner, both in pixels.
  PointFactor(const ChainKind& kind, const TimedBearing& target, double weight)
      : Factor(2, kind.CountBlocks() + 2), kind_(kind), target_(target), weight_(weight) {}

  double weight() const { return weight_; }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  ChainKind kind_;
  TimedBearing target_;
  double weight_;
};

// The measured depth of a point along the axis of a camera that observes it:
//   r = weight * ( TimedDepth::Expected(1 / z_Ct) - 1 / depth ).
// Blocks: those of the chain T_Ct_Ch, depth stream (5), point (3). Evaluate() fails if the point is
// behind the target camera.
class DepthFactor final : public Factor {
 public:
  // `weight`: one over the standard deviation of the inverse depth [m].
  DepthFactor(const ChainKind& kind, const TimedDepth& depth, double weight)
      : Factor(1, kind.CountBlocks() + 2), kind_(kind), depth_(depth), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  ChainKind kind_;
  TimedDepth depth_;
  double weight_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/geometry/so3.h"
#include "vins_estimator/factors/camera_chain.h"
#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/geometry/segment_end_points.h"

namespace plm_vins {

// Lines along a CameraChain, and their derivatives.

using LineChain = CameraChain<PluckerLine>;

// Derivative of a residual with two rows with respect to the moment and the direction of a line.
struct LineDerivative {
  Eigen::Matrix<double, 2, 3> moment, direction;
};

inline PluckerLine ToParent(const PoseBlock& pose, const PluckerLine& line) {
  const Eigen::Vector3d direction = pose.R * line.direction;
  return {pose.R * line.moment + pose.p.cross(direction), direction};
}
inline PluckerLine ToChild(const PoseBlock& pose, const PluckerLine& line) {
  return {pose.R.transpose() * (line.moment - pose.p.cross(line.direction)),
          pose.R.transpose() * line.direction};
}

inline LineDerivative ByParent(const PoseBlock& pose, const LineDerivative& by_child) {
  const Eigen::Matrix<double, 2, 3> moment = by_child.moment * pose.R.transpose();
  return {moment, by_child.direction * pose.R.transpose() - moment * Skew(pose.p)};
}
inline LineDerivative ByChild(const PoseBlock& pose, const LineDerivative& by_parent) {
  return {by_parent.moment * pose.R,
          (by_parent.direction + by_parent.moment * Skew(pose.p)) * pose.R};
}

inline void AddPoseDerivative(double sign, const LineDerivative& by_child,
                              const PluckerLine& in_child, const LineDerivative& by_parent,
                              const PluckerLine& in_parent, PoseDerivative<2>* sum) {
  sum->position -= sign * by_parent.moment * Skew(in_parent.direction);
  sum->rotation -= sign * by_child.moment * Skew(in_child.moment);
  sum->rotation -= sign * by_child.direction * Skew(in_child.direction);
}

// Writes the Jacobian with respect to a line's coordinates.
inline void SetLineJacobian(const LineDerivative& by_host, const double* line, double* values) {
  const PluckerJacobian plucker = ToPluckerJacobian(line);
  Eigen::Map<Eigen::Matrix<double, 2, kLineSize, Eigen::RowMajor>> J(values);
  J.leftCols<kLineTangentSize>() =
      by_host.moment * plucker.d_moment + by_host.direction * plucker.d_direction;
  J.rightCols<1>().setZero();
}

// Reprojection of a line into a camera that observes it:
//   r = weights * EndPointDistances(segment, moment of T_Ct_Ch L_Ch), one by one.
// Blocks: those of the chain T_Ct_Ch, line (5). Jacobians follow factors/manifolds.h.
class LineFactor final : public Factor {
 public:
  // `weights`: one over the standard deviations of start and end across the line, normalized.
  LineFactor(const ChainKind& kind, const SegmentEndPoints& segment, const Eigen::Vector2d& weights)
      : Factor(2, kind.CountBlocks() + 1), kind_(kind), segment_(segment), weights_(weights) {}

  const SegmentEndPoints& segment() const { return segment_; }
  const Eigen::Vector2d& weights() const { return weights_; }
  void set_segment(const SegmentEndPoints& segment) { segment_ = segment; }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    return EvaluateWithNormal(parameters, residuals, jacobians, nullptr);
  }
  // Evaluates and also returns the unit normal of the projected line, which is the derivative of
  // each distance with respect to its end point; `normal` may be null.
  bool EvaluateWithNormal(double const* const* parameters, double* residuals, double** jacobians,
                          Eigen::Vector2d* normal) const;

 private:
  ChainKind kind_;
  SegmentEndPoints segment_;
  Eigen::Vector2d weights_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
// Factors for observations of landmarks by a second camera C1 of the body and by depth images.
#pragma once

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/depth_stream.h"
#include "vins_estimator/geometry/line_segment_view.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/geometry/point_in_host.h"
#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

// Reprojection of a point into the second camera of a frame other than its host:
//   r = weight * ( pi(T_C_C1^-1 T_B_C^-1 T_W_Bt^-1 T_W_Bh T_B_C p_Ch) - m_t(td) )
// Blocks: pose of host (7), pose of target (7), extrinsics T_B_C (7), mounting T_C_C1 (7), time
// offset td (1), point (3). Jacobians follow factors/manifolds.h. Evaluate() fails if the point
// is not in front of the second camera.
class RightPointFactor final : public SizedFactor<2, 7, 7, 7, 7, 1, kPointSize> {
 public:
  // `weight`: see PointFactor.
  RightPointFactor(const TimedBearing& target, double weight) : target_(target), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  TimedBearing target_;
  double weight_;
};

// Reprojection into the second camera of the host itself, which depends on no pose: r = weight * (
// pi(T_C_C1^-1 p_Ch) - m_h(td) ). Blocks: mounting T_C_C1 (7), time offset td (1), point (3).
class RightPointHostFactor final : public SizedFactor<2, 7, 1, kPointSize> {
 public:
  RightPointHostFactor(const TimedBearing& host, double weight) : host_(host), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  TimedBearing host_;
  double weight_;
};

// Reprojection of a line into the second camera of a frame other than its host:
//   r = weights * EndPointDistances(view, moment of T_C_C1^-1 T_B_C^-1 T_W_Bt^-1 T_W_Bh T_B_C L_Ch)
// Blocks: pose of host (7), pose of target (7), extrinsics T_B_C (7), mounting T_C_C1 (7), line
// (5).
class RightLineFactor final : public SizedFactor<2, 7, 7, 7, 7, kLineSize> {
 public:
  using Weight = Eigen::Vector2d;

  // `weights`: one over the standard deviations of start and end across the line, normalized.
  RightLineFactor(const LineSegmentView& view, const Eigen::Vector2d& weights)
      : view_(view), weights_(weights) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    return EvaluateWithNormal(parameters, residuals, jacobians, nullptr);
  }
  // See LineFactor.
  bool EvaluateWithNormal(double const* const* parameters, double* residuals, double** jacobians,
                          Eigen::Vector2d* normal) const;

 private:
  LineSegmentView view_;
  Eigen::Vector2d weights_;
};

// Reprojection of a line into the second camera of its host. Blocks: mounting T_C_C1 (7), line (5).
class RightLineHostFactor final : public SizedFactor<2, 7, kLineSize> {
 public:
  using Weight = Eigen::Vector2d;

  RightLineHostFactor(const LineSegmentView& view, const Eigen::Vector2d& weights)
      : view_(view), weights_(weights) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    return EvaluateWithNormal(parameters, residuals, jacobians, nullptr);
  }
  // See LineFactor.
  bool EvaluateWithNormal(double const* const* parameters, double* residuals, double** jacobians,
                          Eigen::Vector2d* normal) const;

 private:
  LineSegmentView view_;
  Eigen::Vector2d weights_;
};

// The measured depth of a point in a frame other than its host:
//   r = weight * ( TimedDepth::Expected(1 / z_Ct) - 1 / depth ).
// Blocks: pose of host (7), pose of target (7), extrinsics T_B_C (7), depth stream (2), point (3).
class DepthFactor final : public SizedFactor<1, 7, 7, 7, kDepthStreamSize, kPointSize> {
 public:
  // `weight`: one over the standard deviation of the inverse depth [m].
  DepthFactor(const TimedDepth& depth, double weight) : depth_(depth), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  TimedDepth depth_;
  double weight_;
};

// The measured depth of a point in the host itself, with 1 / z_Ch as in the point. Blocks: depth
// stream (2), point (3).
class DepthHostFactor final : public SizedFactor<1, kDepthStreamSize, kPointSize> {
 public:
  DepthHostFactor(const TimedDepth& depth, double weight) : depth_(depth), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  TimedDepth depth_;
  double weight_;
};

}  // namespace plm_vins

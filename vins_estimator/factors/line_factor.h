// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/line_segment_view.h"
#include "vins_estimator/geometry/plucker.h"

namespace plm_vins {

// Reprojection of a line into a frame other than its host:
//   r = weight * EndPointDistances(view, moment of T_B_C^-1 T_W_Bt^-1 T_W_Bh T_B_C L_Ch)
// Blocks: pose of host (7), pose of target (7), extrinsics T_B_C (7), line (5). Jacobians follow
// factors/manifolds.h.
class LineFactor final : public SizedFactor<2, 7, 7, 7, kLineSize> {
 public:
  using Weight = double;

  // `weight`: focal length over the standard deviation of an end point across the line, in pixels.
  LineFactor(const LineSegmentView& view, double weight) : view_(view), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    return EvaluateWithNormal(parameters, residuals, jacobians, nullptr);
  }
  // Evaluates and also returns the unit normal of the projected line, which is the derivative of
  // each distance with respect to its end point; `normal` may be null.
  bool EvaluateWithNormal(double const* const* parameters, double* residuals, double** jacobians,
                          Eigen::Vector2d* normal) const;

 private:
  LineSegmentView view_;
  double weight_;
};

// Observation in the host frame: r = weight * EndPointDistances(view, moment of L_Ch). Block: line
// (5).
class LineHostFactor final : public SizedFactor<2, kLineSize> {
 public:
  using Weight = double;

  LineHostFactor(const LineSegmentView& view, double weight) : view_(view), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    return EvaluateWithNormal(parameters, residuals, jacobians, nullptr);
  }
  // See LineFactor.
  bool EvaluateWithNormal(double const* const* parameters, double* residuals, double** jacobians,
                          Eigen::Vector2d* normal) const;

 private:
  LineSegmentView view_;
  double weight_;
};

}  // namespace plm_vins

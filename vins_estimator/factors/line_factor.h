// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vins_estimator/factors/camera_chain.h"
#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/segment_end_points.h"

namespace plm_vins {

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

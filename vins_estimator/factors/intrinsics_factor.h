// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/line_segment_view.h"
#include "vins_estimator/geometry/ray_shift.h"

namespace plm_vins {

// Extends a corner's factor (PointFactor, PointHostFactor, or those of the second camera) by the
// camera's intrinsics c as a variable: the corner is observed at xy + shift(c), which the residual
// weight * (m_t - xy) depends on directly. Blocks: those of the inner factor, intrinsics (8).
template <typename Inner>
class PointIntrinsicsFactor final : public Factor {
 public:
  static constexpr int kBlocks = Inner::kBlocks + 1;

  // `weight` must be that of `factor`.
  PointIntrinsicsFactor(const Inner& factor, const RayShift& shift, double weight);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Inner factor_;
  RayShift shift_;
  double weight_;
};

// Extends a line's factor (of either camera) by the camera's intrinsics c: the ends of
// the segment are observed at xy + shift(c). Blocks: those of the inner factor, intrinsics (8).
template <typename Inner>
class LineIntrinsicsFactor final : public Factor {
 public:
  static constexpr int kBlocks = Inner::kBlocks + 1;

  using Weight = typename Inner::Weight;

  LineIntrinsicsFactor(const LineSegmentView& view, const Weight& weight,
                       const RayShift& start_shift, const RayShift& end_shift);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  LineSegmentView view_;
  Weight weight_;
  RayShift start_shift_, end_shift_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/factors/line_factor.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/geometry/ray_shift.h"

namespace plm_vins {

// Extends a PointFactor by the intrinsics c of the observing camera as a variable: the corner is
// observed at xy + shift(c), which the residual weight * (m_t - xy) depends on directly. Blocks:
// those of the inner factor, intrinsics (8).
class PointIntrinsicsFactor final : public Factor {
 public:
  PointIntrinsicsFactor(const PointFactor& factor, const RayShift& shift)
      : Factor(2, factor.num_blocks() + 1), factor_(factor), shift_(shift) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  PointFactor factor_;
  RayShift shift_;
};

// Extends a LineFactor by the intrinsics c of the observing camera: the ends of the segment are
// observed at xy + shift(c). Blocks: those of the inner factor, intrinsics (8).
class LineIntrinsicsFactor final : public Factor {
 public:
  LineIntrinsicsFactor(const LineFactor& factor, const RayShift& start_shift,
                       const RayShift& end_shift)
      : Factor(2, factor.num_blocks() + 1),
        factor_(factor),
        start_shift_(start_shift),
        end_shift_(end_shift) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  LineFactor factor_;
  RayShift start_shift_, end_shift_;
};

}  // namespace plm_vins

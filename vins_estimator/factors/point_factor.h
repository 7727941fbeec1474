// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/factors/camera_chain.h"
#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

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

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/factors/camera_chain.h"
#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/depth_stream.h"

namespace plm_vins {

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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/point_in_host.h"
#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

// Reprojection of a point into a frame other than its host:
//   r = weight * ( pi(T_B_C^-1 T_W_Bt^-1 T_W_Bh T_B_C p_Ch) - m_t(td) )
// Blocks: pose of host (7), pose of target (7), extrinsics T_B_C (7), time offset td (1), point
// (3). Jacobians follow factors/manifolds.h. Evaluate() fails if the point is behind the target
// camera.
class PointFactor final : public SizedFactor<2, 7, 7, 7, 1, kPointSize> {
 public:
  static constexpr int kTdBlock = 3;

  // `weight`: focal length over the standard deviation of a corner, both in pixels.
  PointFactor(const TimedBearing& target, double weight) : target_(target), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  TimedBearing target_;
  double weight_;
};

// Observation in the host frame: r = weight * ( (x, y) - m_h(td) ). Blocks: time offset td (1),
// point (3).
class PointHostFactor final : public SizedFactor<2, 1, kPointSize> {
 public:
  static constexpr int kTdBlock = 0;

  PointHostFactor(const TimedBearing& host, double weight) : host_(host), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  TimedBearing host_;
  double weight_;
};

}  // namespace plm_vins

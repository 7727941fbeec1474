// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/geometry/rigid3.h"
#include "vins_estimator/factors/factor.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {

// Standard deviations of the configured pose of one camera in another.
struct RelativePoseDeviation {
  double across;    // position across the baseline [m]
  double along;     // position along the baseline, which is an error of its length [m]
  double rotation;  // [rad]
};

// Prior on the pose of a camera j in a camera i, T = T_B_Ci^-1 T_B_Cj, whose configured value is
// T0:
//   r = [ E^T (t - t0) / deviations, Log(R0^T R) / deviation ],
// with two columns of E across the baseline t0 and one along it. Blocks: extrinsics T_B_Ci (7),
// T_B_Cj (7). Jacobians follow factors/manifolds.h.
class ExtrinsicsPrior final : public SizedFactor<6, kPoseSize, kPoseSize> {
 public:
  ExtrinsicsPrior(const Rigid3d& T_Ci_Cj, const RelativePoseDeviation& deviation);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::Vector3d t0_;
  Eigen::Matrix3d R0_;
  Eigen::Matrix3d position_weight_;
  double rotation_weight_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/plucker.h"

namespace plm_vins {

// Constrains a line, given in its host camera, to be parallel to a known axis of W:
//   r = weight * E^T d_W,   d_W = R_W_Bh R_B_C d_Ch,
// with the line's unit direction d and the two columns of E perpendicular to the axis. |r| / weight
// is the sine of the angle between line and axis, regardless of sign. Blocks: pose of host (7),
// extrinsics T_B_C (7), line (5). Jacobians follow factors/manifolds.h. A vertical axis constrains
// roll and pitch, a horizontal one the heading as well.
class ManhattanFactor final : public SizedFactor<2, 7, 7, kLineSize> {
 public:
  // `axis_W` is a unit vector; `weight` is the inverse standard deviation of that angle [1/rad].
  ManhattanFactor(const Eigen::Vector3d& axis_W, double weight);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::Matrix<double, 2, 3> across_;  // weight * E^T
};

}  // namespace plm_vins

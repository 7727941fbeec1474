// SPDX-License-Identifier: BSD-3-Clause
// What is known of a body that stands still (imu/standstill_detector.h): its velocity is zero and
// its pose does not change. Both soft, with standard deviations that say how still "still" is.
#pragma once

#include "vins_estimator/factors/factor.h"

namespace plm_vins {

// residual = v_W / sigma, for one motion block.
class ZeroVelocityFactor final : public SizedFactor<3, 9> {
 public:
  explicit ZeroVelocityFactor(double sigma_velocity)  // [m/s]
      : weight_(1.0 / sigma_velocity) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  double weight_;
};

// residual = [(p_j - p_i) / sigma_position, Log(q_i^-1 q_j) / sigma_rotation], for two poses.
class SamePoseFactor final : public SizedFactor<6, 7, 7> {
 public:
  SamePoseFactor(double sigma_position, double sigma_rotation)  // [m], [rad]
      : position_weight_(1.0 / sigma_position), rotation_weight_(1.0 / sigma_rotation) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  double position_weight_, rotation_weight_;
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
// Soft constraints of a standstill (imu/standstill_detector.h): zero velocity and constant pose.
// The standard deviations state the motion that still counts as standstill.
#pragma once

#include "vins_estimator/factors/factor.h"

namespace plm_vins {

// residual = v_W / sigma, on one motion block.
class ZeroVelocityFactor final : public SizedFactor<3, 9> {
 public:
  explicit ZeroVelocityFactor(double sigma_velocity)  // [m/s]
      : weight_(1.0 / sigma_velocity) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  double weight_;
};

// residual = [(p_j - p_i) / sigma_position, Log(q_i^-1 q_j) / sigma_rotation], on two poses.
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "common/camera/camera_model.h"
#include "common/config/config.h"

namespace plm_vins {

// Linearization point of the variables in the prior. With kValues, the solution is the minimum of
// the cost. With kFirstEstimates, the points at which the prior was linearized, the equations carry
// no information on the unobservable position and heading ([Huang2010]); this is used to
// marginalize.
enum class JacobiansAt { kValues, kFirstEstimates };

// Weights of the terms in the window problem, and the calibration that it estimates.
struct ProblemOptions {
  // `focal_length` [px] converts pixels to normalized coordinates.
  ProblemOptions(const Config& config, double focal_length);

  // Sets the weights of points and lines from their noise, normalized.
  void SetNoise(double point_noise, double line_noise);

  // Limits the certainty of standstill: image flow up to `flow` [1/s] is indistinguishable from it.
  // Has no effect if the scene's median depth [m] is unknown.
  void LetPass(double flow, std::optional<double> depth);

  double point_weight;            // inverse standard deviation of a corner, normalized
  double point_loss_scale = 1.0;  // Cauchy loss, in standard deviations
  double line_weight;             // inverse standard deviation of an end point across its line
  double line_loss_scale = 1.0;   // Cauchy loss, in standard deviations
  double right_weight;            // inverse standard deviation of a corner in the second camera
  double right_loss_scale = 1.0;  // Cauchy loss, in standard deviations
  double right_line_noise_factor = 1;  // on the stated deviations of lines in the second camera
  double depth_weight = 0;             // inverse standard deviation of a measured inverse depth [m]
  double depth_loss_scale = 1.0;       // Cauchy loss, in standard deviations
  double anchor_weight;                // inverse standard deviation of an end point in an anchor
  double manhattan_weight;            // inverse standard deviation of the angle to the axis [1/rad]
  double manhattan_loss_scale = 3.0;  // Tukey loss, in standard deviations
  double standstill_velocity = 0.005;   // standard deviation at standstill [m/s]
  double standstill_position = 0.001;   // standard deviation of the position between two frames [m]
  double standstill_rotation = 0.0005;  // standard deviation of the rotation between frames [rad]
  // Steady motion that is indistinguishable from standstill: a lower bound on its standard
  // deviations.
  double passing_velocity = 0;   // [m/s]
  double passing_turn_rate = 0;  // [rad/s]
  bool estimate_extrinsic;
  bool estimate_mounting;  // mounting of the second camera
  bool estimate_depth_stream;
  bool estimate_td;
  bool estimate_intrinsics;
  CameraParameters camera;                       // configured camera
  std::optional<CameraParameters> right_camera;  // configured second camera, if there is one
  JacobiansAt jacobians_at = JacobiansAt::kFirstEstimates;
  // Manhattan frame to whose axes lines are constrained; nullopt if there is none.
  std::optional<Eigen::Quaterniond> R_W_M;
};

}  // namespace plm_vins

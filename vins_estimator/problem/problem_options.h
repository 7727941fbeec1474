// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "common/camera/camera_model.h"
#include "common/config/config.h"

namespace plm_vins {

// Where Jacobians by the variables of the prior are taken. At the values, the solution is the
// minimum of the cost. At the first estimates, which the prior was linearised at, equations say
// nothing of position and heading that cannot be known ([Huang2010]): for what stays in the prior.
enum class JacobiansAt { kValues, kFirstEstimates };

// What weighs the terms of the window problem, and which calibration it estimates.
struct ProblemOptions {
  // `focal_length` [px] turns pixels into normalised coordinates.
  ProblemOptions(const Config& config, double focal_length);

  // Weighs the views of points and lines by their noise, normalised.
  void SetNoise(double point_noise, double line_noise);

  // Lets a flow of this much [1/s] pass as standstill, where the depth [m] of what is seen is
  // known.
  void LetPass(double flow, std::optional<double> depth);

  double point_weight;                  // one over the noise of a corner, normalised
  double point_loss_scale = 1.0;        // Cauchy loss, in standard deviations
  double line_weight;                   // ... of a line's ends across it
  double line_loss_scale = 1.0;         // Cauchy loss, in standard deviations
  double anchor_weight;                 // the same, of what anchors have seen
  double manhattan_weight;              // one over the deviation of a line from its axis [1/rad]
  double manhattan_loss_scale = 3.0;    // Tukey loss, in standard deviations
  double standstill_velocity = 0.005;   // standard deviation while standing still [m/s]
  double standstill_position = 0.001;   // ... of the position between two frames [m]
  double standstill_rotation = 0.0005;  // ... of the rotation between two frames [rad]
  // What of steady motion passes as standstill, which is then no better known than by that.
  double passing_velocity = 0;   // [m/s]
  double passing_turn_rate = 0;  // [rad/s]
  bool estimate_extrinsic;
  bool estimate_td;
  bool estimate_readout;  // time of a rolling shutter
  bool estimate_intrinsics;
  CameraParameters camera;  // as configured
  JacobiansAt jacobians_at = JacobiansAt::kFirstEstimates;
  // Lines on its axes are held to them; none where there is no such frame.
  std::optional<Eigen::Quaterniond> R_W_M;
};

}  // namespace plm_vins

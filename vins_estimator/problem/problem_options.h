// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "vins_estimator/factors/priors.h"

namespace plm_vins {

// Linearization point of the variables in the prior. With kValues, the solution is the minimum of
// the cost. With kFirstEstimates, the points at which the prior was linearized, the equations carry
// no information on the unobservable position and heading ([Huang2010]); this is used to
// marginalize.
enum class JacobiansAt { kValues, kFirstEstimates };

// Relative standard deviations of the baseline of a calibrated stereo camera, and of the scale of
// measured depths. The baseline must be known better than an accelerometer knows lengths: its scale
// factor may be wrong by 1 %, which would otherwise stretch the baseline and the path.
constexpr double kBaselineDeviation = 0.0005;
constexpr double kDepthScaleDeviation = 0.002;

// The configured pose of a camera j in a camera i, with a lower number.
struct ExtrinsicsLink {
  int i, j;
  Rigid3d T_Ci_Cj;
  bool is_pair;  // a stereo pair: both observe the same points
  RelativePoseDeviation deviation;
};

// A camera as configured, and the weights of its observations.
struct ProblemCamera {
  CameraParameters parameters;
  double noise_ratio = 1;        // noise, normalized, over that of the first camera
  double point_weight = 0;       // inverse standard deviation of a corner, normalized
  double line_noise_factor = 1;  // on the deviations of end points
};

// Weights of the terms in the window problem, and the calibration that it estimates.
struct ProblemOptions {
  // `focal_length` [px] converts pixels to normalized coordinates.
  ProblemOptions(const Config& config, double focal_length);

  // Sets the weights of points and lines from their noise in the first camera, normalized.
  void SetNoise(double point_noise, double line_noise);

  // Limits the certainty of standstill: image flow up to `flow` [1/s] is indistinguishable from it.
  // Has no effect if the scene's median depth [m] is unknown.
  void LetPass(double flow, std::optional<double> depth);

  std::vector<ProblemCamera> cameras;  // by number
  double point_loss_scale = 1.0;       // Cauchy loss, in standard deviations
  double line_weight;                  // inverse standard deviation of an end point across its line
  double line_loss_scale = 1.0;        // Cauchy loss, in standard deviations
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
  bool estimate_extrinsic;       // of the first camera; those of others are always estimated
  std::vector<ExtrinsicsLink> extrinsics_links;  // one for each camera but the first
  bool estimate_depth_stream;
  bool estimate_td;
  bool estimate_intrinsics;
  JacobiansAt jacobians_at = JacobiansAt::kFirstEstimates;
  // Manhattan frame to whose axes lines are constrained; nullopt if there is none.
  std::optional<Eigen::Quaterniond> R_W_M;
};

}  // namespace plm_vins

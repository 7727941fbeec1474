// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/problem_options.h"

#include <cmath>

namespace plm_vins {
namespace {

// Anchor observations of a recognized line are already contained in the prior, and the line may be
// confused with a similar one; so they are down-weighted.
constexpr double kAnchorNoise = 5.0;  // times the noise of lines

}  // namespace

ProblemOptions::ProblemOptions(const Config& config, double focal_length)
    : manhattan_weight(180 / (M_PI * config.estimator.manhattan_noise)),
      estimate_extrinsic(config.sensor.estimate_extrinsic != SensorConfig::ExtrinsicMode::kFixed),
      estimate_mounting(config.sensor.cameras.size() > 1),
      estimate_depth_stream(config.sensor.depth.has_value()),
      estimate_td(config.sensor.estimate_td),
      estimate_intrinsics(config.sensor.estimate_intrinsics),
      camera(config.sensor.cameras[0].parameters) {
  if (config.sensor.depth) depth_weight = 1 / config.sensor.depth->noise;
  if (config.sensor.cameras.size() > 1) right_camera = config.sensor.cameras[1].parameters;
  SetNoise(config.estimator.point_noise / focal_length, config.estimator.line_noise / focal_length);
}

void ProblemOptions::SetNoise(double point_noise, double line_noise) {
  point_weight = right_weight = 1 / point_noise;
  line_weight = 1 / line_noise;
  anchor_weight = line_weight / kAnchorNoise;
}

void ProblemOptions::LetPass(double flow, std::optional<double> depth) {
  if (!depth) return;
  passing_velocity = flow * *depth;
  passing_turn_rate = flow;
}

}  // namespace plm_vins

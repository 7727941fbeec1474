// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/problem_options.h"

#include <cmath>

namespace plm_vins {
namespace {

// What an anchor has seen of a line that comes back is part of the prior already, and the line may
// be another one that looks the same; so it counts less.
constexpr double kAnchorNoise = 5.0;  // in units of the noise of lines

}  // namespace

ProblemOptions::ProblemOptions(const Config& config, double focal_length)
    : manhattan_weight(180 / (M_PI * config.estimator.manhattan_noise)),
      estimate_extrinsic(config.sensor.estimate_extrinsic != SensorConfig::ExtrinsicMode::kFixed),
      estimate_td(config.sensor.estimate_td),
      estimate_readout(config.sensor.estimate_rolling_shutter_tr),
      estimate_intrinsics(config.sensor.estimate_intrinsics),
      camera(config.sensor.camera) {
  SetNoise(config.estimator.point_noise / focal_length, config.estimator.line_noise / focal_length);
}

void ProblemOptions::SetNoise(double point_noise, double line_noise) {
  point_weight = 1 / point_noise;
  line_weight = 1 / line_noise;
  anchor_weight = line_weight / kAnchorNoise;
}

void ProblemOptions::LetPass(double flow, std::optional<double> depth) {
  if (!depth) return;
  passing_velocity = flow * *depth;
  passing_turn_rate = flow;
}

}  // namespace plm_vins

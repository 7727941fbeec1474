// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/problem_options.h"

#include <cmath>

#include "common/config/stereo_pairs.h"

namespace plm_vins {
namespace {

// Anchor observations of a recognized line are already contained in the prior, and the line may be
// confused with a similar one; so they are down-weighted.
constexpr double kAnchorNoise = 5.0;  // times the noise of lines

// Standard deviations of calibrated extrinsics: the rotation between the cameras of a stereo pair,
// which is also that of the direction of their baseline; and those between other cameras.
constexpr double kPairRotation = 0.05 * M_PI / 180;  // [rad]
constexpr double kRigRotation = 0.5 * M_PI / 180;    // [rad]
constexpr double kRigPosition = 0.01;                // [m]

constexpr double kManhattanNoise_deg = 1;  // standard deviation of a line from its axis

// Links the second camera of a stereo pair to the first one, and other cameras to camera 0.
ExtrinsicsLink LinkOf(const SensorConfig& sensor, int camera) {
  const auto link = [&](int other) {
    return sensor.cameras[other].T_B_C.Inverse() * sensor.cameras[camera].T_B_C;
  };
  for (const StereoPair& pair : StereoPairs(sensor)) {
    if (pair.second != camera) continue;
    const Rigid3d T_first_second = link(pair.first);
    const double length = T_first_second.translation.norm();
    return {pair.first,
            camera,
            T_first_second,
            /*is_pair=*/true,
            {kPairRotation * length, kBaselineDeviation * length, kPairRotation}};
  }
  return {0, camera, link(0), /*is_pair=*/false, {kRigPosition, kRigPosition, kRigRotation}};
}

}  // namespace

ProblemOptions::ProblemOptions(const Config& config, double focal_length)
    : manhattan_weight(180 / (M_PI * kManhattanNoise_deg)),
      estimate_extrinsic(config.sensor.estimate_extrinsic != SensorConfig::ExtrinsicMode::kFixed),
      estimate_depth_stream(config.sensor.depth.has_value()),
      estimate_td(config.sensor.estimate_td),
      estimate_intrinsics(config.sensor.estimate_intrinsics) {
  const std::vector<CameraSensor>& sensors = config.sensor.cameras;
  for (size_t i = 0; i < sensors.size(); ++i) {
    const CameraParameters& parameters = sensors[i].parameters;
    const double ratio = i == 0 ? 1 : focal_length / CameraModel::Create(parameters)->FocalLength();
    cameras.push_back({parameters, ratio});
    if (i > 0) extrinsics_links.push_back(LinkOf(config.sensor, static_cast<int>(i)));
  }
  if (config.sensor.depth) depth_weight = 1 / config.sensor.depth->noise;
  SetNoise(config.estimator.point_noise / focal_length, config.estimator.line_noise / focal_length);
}

void ProblemOptions::SetNoise(double point_noise, double line_noise) {
  for (ProblemCamera& camera : cameras)
    camera.point_weight = 1 / (point_noise * camera.noise_ratio);
  line_weight = 1 / line_noise;
  anchor_weight = line_weight / kAnchorNoise;
}

void ProblemOptions::LetPass(double flow, std::optional<double> depth) {
  if (!depth) return;
  passing_velocity = flow * *depth;
  passing_turn_rate = flow;
}

}  // namespace plm_vins

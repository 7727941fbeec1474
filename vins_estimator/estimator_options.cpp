// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimator_options.h"

#include <cmath>

#include "common/camera_model.h"

namespace plm_vins {
namespace {

constexpr double kMinTriangulationAngle_px = 2.0;  // in pixels of motion: well above corner noise
constexpr double kMaxReprojectionError_px = 3.0;
// What an anchor has seen of a line that comes back is part of the prior already, and the line may
// be another one that looks the same; so it counts less.
constexpr double kAnchorNoise = 5.0;  // in units of the noise of lines

ProblemOptions MakeProblemOptions(const Config& config, double focal_length) {
  ProblemOptions options;
  options.point_weight = focal_length / config.estimator.point_noise;
  options.line_weight = focal_length / config.estimator.line_noise;
  options.anchor_weight = options.line_weight / kAnchorNoise;
  options.manhattan_weight = 180 / (M_PI * config.estimator.manhattan_noise);
  options.estimate_extrinsic =
      config.sensor.estimate_extrinsic != SensorConfig::ExtrinsicMode::kFixed;
  options.estimate_td = config.sensor.estimate_td;
  return options;
}

}  // namespace

EstimatorOptions::EstimatorOptions(const Config& config) {
  const EstimatorConfig& estimator = config.estimator;
  const double focal_length = CameraModel::Create(config.sensor.camera)->FocalLength();
  const double line_noise = estimator.line_noise / focal_length;
  map.line_noise = line_noise;
  map.remember_lines = estimator.line_merging;
  keyframes.min_parallax = estimator.keyframe_parallax / focal_length;
  min_triangulation_angle = kMinTriangulationAngle_px / focal_length;
  max_reprojection_error = kMaxReprojectionError_px / focal_length;
  line_triangulation.noise = line_noise;
  line_limits.noise = line_noise;
  line_limits.max_length = estimator.line_outlier_distance;
  same_line.distance = estimator.line_merge_distance;
  same_line.image_distance = estimator.line_merge_image_distance / focal_length;
  same_line.angle = estimator.line_merge_angle * M_PI / 180;
  same_line.noise = line_noise;
  anchors.max_anchors = estimator.line_merging ? static_cast<size_t>(estimator.line_anchors) : 0;
  problem = MakeProblemOptions(config, focal_length);
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimator_options.h"

#include "common/camera/camera_model.h"

namespace plm_vins {
namespace {

constexpr double kMinTriangulationAngle_px = 2.0;  // in pixels of motion: well above corner noise
constexpr double kMaxReprojectionError_px = 3.0;
constexpr double kMaxRayError_px = 0.02;  // a tenth of the noise of the best corners
constexpr SolverOptions kFirstSolution = {20, 1e-3};

}  // namespace

EstimatorOptions::EstimatorOptions(const Config& config)
    : EstimatorOptions(config, CameraModel::Create(config.sensor.camera)->FocalLength()) {}

EstimatorOptions::EstimatorOptions(const Config& config, double focal_length)
    : map(config.estimator.line_noise / focal_length, config.estimator.line_merging),
      keyframes(config.estimator, focal_length),
      min_triangulation_angle(kMinTriangulationAngle_px / focal_length),
      max_reprojection_error(kMaxReprojectionError_px / focal_length),
      max_ray_error(kMaxRayError_px / focal_length),
      line_triangulation(config.estimator.line_noise / focal_length),
      line_limits(line_triangulation.noise, config.estimator.line_outlier_distance),
      same_line(config.estimator, focal_length),
      anchors(config.estimator),
      problem(config, focal_length),
      first_solution(kFirstSolution) {
  solution.max_iterations = config.estimator.max_num_iterations;
}

InitialUncertainty UncertaintyOf(const SensorConfig& sensor, bool from_standstill) {
  InitialUncertainty uncertainty;
  if (from_standstill) {
    uncertainty.velocity = 0.03;
    uncertainty.gyro_bias = 0.003;
  }
  if (sensor.estimate_extrinsic == SensorConfig::ExtrinsicMode::kCalibrateRotation) {
    uncertainty.extrinsic_rotation = 0.1;
    uncertainty.extrinsic_position = 0.1;
  }
  uncertainty.intrinsics = sensor.intrinsics_deviation;
  return uncertainty;
}

}  // namespace plm_vins

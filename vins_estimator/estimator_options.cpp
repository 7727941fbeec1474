// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimator_options.h"

#include "common/camera/camera_model.h"

namespace plm_vins {
namespace {

constexpr double kMinTriangulationAngle_px = 2.0;  // in pixels of motion: well above corner noise
constexpr double kMaxReprojectionError_px = 3.0;
constexpr double kMaxDepthError = 4.0;    // for measured inverse depths, in standard deviations
constexpr double kMaxRayError_px = 0.02;  // a tenth of the noise of the best corners

// Motion in half a second: eight times the effect of noise on the median of a hundred corners.
constexpr double kMaxMotionAtRest_px = 0.15;
constexpr double kPassingFlow_px = kMaxMotionAtRest_px / 0.5;  // [px/s]

constexpr SolverOptions kFirstSolution = {20, 0.01};
constexpr SolverOptions kNewestSolution = {5, 0.1};
constexpr double kEarlyTolerance = 0.1;  // fraction of a standard deviation

// Uncertainty after initialization from standstill, which may have been a hover.
constexpr double kStandstillVelocity = 0.03;   // [m/s]
constexpr double kStandstillGyroBias = 0.003;  // [rad/s]
// Mean acceleration of a hover, and what vibration leaves in the mean specific force [m/s^2].
constexpr double kStandstillAcceleration = 0.1;

// Uncertainty if the camera's rotation was just calibrated and its position is unknown.
constexpr double kUnknownCameraRotation = 0.1;  // [rad]
constexpr double kUnknownCameraPosition = 0.1;  // [m]

}  // namespace

EstimatorOptions::EstimatorOptions(const Config& config)
    : EstimatorOptions(config,
                       CameraModel::Create(config.sensor.cameras[0].parameters)->FocalLength()) {}

EstimatorOptions::EstimatorOptions(const Config& config, double focal_length)
    : focal_length(focal_length),
      map(config.estimator.line_noise / focal_length, config.estimator.line_merging),
      keyframes(config.estimator, focal_length),
      min_triangulation_angle(kMinTriangulationAngle_px / focal_length),
      unnoticed_turn_rate(3 * kStandstillGyroBias),
      max_reprojection_error(kMaxReprojectionError_px / focal_length),
      max_inverse_depth_error(kMaxDepthError *
                              (config.sensor.depth ? config.sensor.depth->noise : 0)),
      max_ray_error(kMaxRayError_px / focal_length),
      max_motion_at_rest_px(kMaxMotionAtRest_px),
      passing_flow(kPassingFlow_px / focal_length),
      line_limits(config.estimator.line_noise / focal_length,
                  config.estimator.line_outlier_distance),
      same_line(config.estimator, focal_length),
      anchors(config.estimator),
      problem(config, focal_length),
      newest_solution(kNewestSolution),
      first_solution(kFirstSolution) {
  early_solution.max_iterations = solution.max_iterations = config.estimator.max_num_iterations;
  early_solution.deviation_tolerance = kEarlyTolerance;
}

InitialUncertainty UncertaintyOf(const SensorConfig& sensor, bool from_standstill) {
  InitialUncertainty uncertainty;
  uncertainty.accel_bias = sensor.accel_bias_deviation;
  if (from_standstill) {
    uncertainty.velocity = kStandstillVelocity;
    uncertainty.gyro_bias = kStandstillGyroBias;
    uncertainty.leveled_by = kStandstillAcceleration;
  }
  if (sensor.estimate_extrinsic == SensorConfig::ExtrinsicMode::kCalibrateRotation) {
    uncertainty.extrinsic_rotation = kUnknownCameraRotation;
    uncertainty.extrinsic_position = kUnknownCameraPosition;
  }
  uncertainty.intrinsics = sensor.intrinsics_deviation;
  return uncertainty;
}

}  // namespace plm_vins

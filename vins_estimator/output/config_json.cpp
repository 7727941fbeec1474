// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/config_json.h"

namespace plm_vins {
namespace {

std::string ModelName(CameraParameters::Model model) {
  switch (model) {
    case CameraParameters::Model::kPinholeRadtan:
      return "PINHOLE";
    case CameraParameters::Model::kPinholeEquidistant:
      return "KANNALA_BRANDT";
    default:
      return "MEI";
  }
}

Json CameraToJson(const CameraParameters& camera) {
  const Eigen::Vector4d& d = camera.distortion;
  return {{"model_type", ModelName(camera.model)},
          {"image_width", camera.width},
          {"image_height", camera.height},
          {"projection_parameters", {camera.fx, camera.fy, camera.cx, camera.cy}},
          {"distortion_parameters", {d[0], d[1], d[2], d[3]}},
          {"xi", camera.xi}};
}

Json TransformToJson(const Rigid3d& T) {
  const Eigen::Quaterniond& q = T.rotation;
  const Eigen::Vector3d& p = T.translation;
  return {{"q_xyzw", {q.x(), q.y(), q.z(), q.w()}}, {"p", {p.x(), p.y(), p.z()}}};
}

Json SensorToJson(const SensorConfig& sensor) {
  return {{"image_topic", sensor.image_topic},
          {"imu_topic", sensor.imu_topic},
          {"camera", CameraToJson(sensor.camera)},
          {"T_B_C", TransformToJson(sensor.T_B_C)},
          {"estimate_extrinsic", static_cast<int>(sensor.estimate_extrinsic)},
          {"td", sensor.td},
          {"estimate_td", sensor.estimate_td},
          {"gyro_density", sensor.imu_noise.gyro_density},
          {"accel_density", sensor.imu_noise.accel_density},
          {"gyro_walk", sensor.imu_noise.gyro_walk},
          {"accel_walk", sensor.imu_noise.accel_walk},
          {"gravity_norm", sensor.gravity_norm}};
}

Json PointsToJson(const PointTrackerConfig& points) {
  const bool harris = points.corner_detector == CornerDetectorType::kHarris;
  return {{"corner_detector", harris ? "harris" : "shi_tomasi"},
          {"corner_subpixel", points.corner_subpixel},
          {"max_cnt", points.max_cnt},
          {"min_dist", points.min_dist},
          {"f_threshold", points.f_threshold},
          {"equalize", points.equalize},
          {"fisheye_mask", points.fisheye_mask},
          {"quality_level", points.quality_level},
          {"klt_window", points.klt_window},
          {"klt_levels", points.klt_levels},
          {"forward_backward", points.forward_backward}};
}

const char* Name(LineDetectorType type) {
  switch (type) {
    case LineDetectorType::kFld:
      return "fld";
    case LineDetectorType::kLsd:
      return "lsd";
    default:
      return "edlines";
  }
}

Json LinesToJson(const LineTrackerConfig& lines) {
  const bool lbd = lines.line_matcher == LineMatcherType::kLbd;
  return {{"line_detector", Name(lines.line_detector)},
          {"line_matcher", lbd ? "lbd" : "flow"},
          {"half_resolution", lines.half_resolution},
          {"join_fragments", lines.join_fragments},
          {"max_lines", lines.max_lines},
          {"min_length", lines.min_length},
          {"border", lines.border},
          {"min_gradient", lines.min_gradient},
          {"spacing", lines.spacing},
          {"refill_below", lines.refill_below},
          {"refill_interval", lines.refill_interval},
          {"max_angle", lines.max_angle},
          {"max_distance", lines.max_distance},
          {"min_overlap", lines.min_overlap},
          {"min_correlation", lines.min_correlation},
          {"max_descriptor_distance", lines.max_descriptor_distance}};
}

Json EstimatorToJson(const EstimatorConfig& estimator) {
  return {{"window_size", estimator.window_size},
          {"keyframe_parallax", estimator.keyframe_parallax},
          {"max_num_iterations", estimator.max_num_iterations},
          {"point_noise", estimator.point_noise},
          {"line_noise", estimator.line_noise},
          {"line_outlier_distance", estimator.line_outlier_distance},
          {"line_merging", estimator.line_merging},
          {"line_merge_distance", estimator.line_merge_distance},
          {"line_merge_image_distance", estimator.line_merge_image_distance},
          {"line_merge_angle", estimator.line_merge_angle},
          {"manhattan_constraints", estimator.manhattan_constraints},
          {"manhattan_noise", estimator.manhattan_noise},
          {"zero_velocity_update", estimator.zero_velocity_update}};
}

}  // namespace

Json ToJson(const Config& config) {
  return {{"file", config.file},
          {"sensor", SensorToJson(config.sensor)},
          {"publish_rate", config.publish_rate},
          {"points", PointsToJson(config.points)},
          {"use_lines", config.use_lines},
          {"lines", LinesToJson(config.lines)},
          {"estimator", EstimatorToJson(config.estimator)}};
}

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_keys.h"

#include <Eigen/Geometry>

namespace plm_vins {
namespace {

using Model = ConfigDraft::ModelType;
using Extrinsic = SensorConfig::ExtrinsicMode;
using C = CameraParameters;
using D = ConfigDraft;
using E = EstimatorConfig;
using L = LineTrackerConfig;
using N = ImuNoise;
using O = OutputConfig;
using P = PointTrackerConfig;
using S = SensorConfig;

// The field reached through a chain of members.
template <typename... Members>
auto At(Members... members) {
  return [=](ConfigDraft & draft) -> auto& { return (draft.*....*members); };
}

template <typename T>
Field<T> Draft(T D::*member) {
  return At(member);
}
template <typename T>
Field<T> Sensor(T S::*member) {
  return At(&Config::sensor, member);
}
template <typename T>
Field<T> Camera(T C::*member) {
  return At(&Config::sensor, &S::camera, member);
}
template <typename T>
Field<T> Noise(T N::*member) {
  return At(&Config::sensor, &S::imu_noise, member);
}
template <typename T>
Field<T> Points(T P::*member) {
  return At(&Config::points, member);
}
template <typename T>
Field<T> Lines(T L::*member) {
  return At(&Config::lines, member);
}
template <typename T>
Field<T> Estimator(T E::*member) {
  return At(&Config::estimator, member);
}
template <typename T>
Field<T> Output(T O::*member) {
  return At(&Config::output, member);
}

Problem SetRotation(const Eigen::MatrixXd& R_B_C, ConfigDraft& draft) {
  constexpr double kTolerance = 5e-3;  // three decimals are enough
  const Eigen::Matrix3d error = R_B_C * R_B_C.transpose() - Eigen::Matrix3d::Identity();
  if (error.cwiseAbs().maxCoeff() > kTolerance || R_B_C.determinant() < 0) {
    return "is not a rotation (its rows must be of length 1, at right angles, right-handed)";
  }
  draft.sensor.T_B_C.rotation = Eigen::Quaterniond(Eigen::Matrix3d(R_B_C)).normalized();
  return std::nullopt;
}

Problem SetTranslation(const Eigen::MatrixXd& p_B_C, ConfigDraft& draft) {
  if (p_B_C.cwiseAbs().maxCoeff() > 10) return "out of range, must be within 10 m";
  draft.sensor.T_B_C.translation = p_B_C;
  return std::nullopt;
}

ConfigKey RollingShutterKey() {
  const auto read = [](const YAML::Node& value, ConfigDraft&) -> Problem {
    if (ScalarText(value) == "0") return std::nullopt;
    return "must be 0: rolling-shutter cameras are not supported, use a global-shutter camera";
  };
  return {"rolling_shutter", false, read, [](ConfigDraft&) { return "0"; }};
}

ConfigKey DistortionKey(const std::string& name, int index) {
  const auto field = [index](ConfigDraft& draft) -> double& {
    return draft.sensor.camera.distortion[index];
  };
  return NumberKey(name, "", {-10, 10}, field);
}

// Focal lengths and principal point under the names that the model gives them.
std::vector<ConfigKey> ProjectionKeys(const std::string& fx, const std::string& fy,
                                      const std::string& cx, const std::string& cy) {
  const std::string group = "projection_parameters.";
  return {NumberKey(group + fx, "px", {1, 1e5}, Camera(&C::fx)),
          NumberKey(group + fy, "px", {1, 1e5}, Camera(&C::fy)),
          NumberKey(group + cx, "px", {0, 1e5}, Camera(&C::cx)),
          NumberKey(group + cy, "px", {0, 1e5}, Camera(&C::cy))};
}

std::vector<ConfigKey> DistortionKeys(const std::string& group,
                                      const std::vector<std::string>& names) {
  std::vector<ConfigKey> keys;
  for (const std::string& name : names) {
    keys.push_back(DistortionKey(group + "." + name, static_cast<int>(keys.size())));
  }
  return keys;
}

std::vector<ConfigKey> Join(std::vector<ConfigKey> keys, const std::vector<ConfigKey>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

std::vector<ConfigKey> OptionalCameraKeys(Model type) {
  switch (type) {
    case Model::kPinhole:
      return Join(ProjectionKeys("fx", "fy", "cx", "cy"),
                  DistortionKeys("distortion_parameters", {"k1", "k2", "p1", "p2"}));
    case Model::kEquidistant:
      return Join(ProjectionKeys("fx", "fy", "cx", "cy"),
                  DistortionKeys("distortion_parameters", {"k1", "k2", "k3", "k4"}));
    case Model::kKannalaBrandt:  // VINS names: k2 to k5 are k1 to k4 of everybody else
      return Join(ProjectionKeys("mu", "mv", "u0", "v0"),
                  DistortionKeys("projection_parameters", {"k2", "k3", "k4", "k5"}));
    case Model::kMei:
      return Join(Join(ProjectionKeys("gamma1", "gamma2", "u0", "v0"),
                       DistortionKeys("distortion_parameters", {"k1", "k2", "p1", "p2"})),
                  {NumberKey("mirror_parameters.xi", "", {0, 10}, Camera(&C::xi))});
  }
  return {};
}

std::vector<ConfigKey> SensorKeys() {
  return {
      Required(TextKey("image_topic", Sensor(&S::image_topic))),
      Required(TextKey("imu_topic", Sensor(&S::imu_topic))),
      Required(IntegerKey("image_width", "px", {32, 16384}, Camera(&C::width))),
      Required(IntegerKey("image_height", "px", {32, 16384}, Camera(&C::height))),
      ChoiceKey<Extrinsic>("estimate_extrinsic",
                           {{"0", Extrinsic::kFixed},
                            {"1", Extrinsic::kRefine},
                            {"2", Extrinsic::kCalibrateRotation}},
                           Sensor(&S::estimate_extrinsic)),
      MatrixKey("extrinsicRotation", 3, 3, SetRotation),
      MatrixKey("extrinsicTranslation", 3, 1, SetTranslation),
      NumberKey("td", "s", {-1, 1}, Sensor(&S::td)),
      FlagKey("estimate_td", Sensor(&S::estimate_td)),
      RollingShutterKey(),
      ChoiceKey<D::ImuNoiseModel>(
          "imu_noise_model",
          {{"vins", D::ImuNoiseModel::kVins}, {"continuous", D::ImuNoiseModel::kContinuous}},
          Draft(&D::imu_noise_model)),
      NumberKey("imu_rate", "Hz", {10, 10000}, Draft(&D::imu_rate)),
      NumberKey("acc_n", "", {1e-6, 10}, Noise(&N::accel_density)),
      NumberKey("gyr_n", "", {1e-7, 1}, Noise(&N::gyro_density)),
      NumberKey("acc_w", "", {1e-9, 1}, Noise(&N::accel_walk)),
      NumberKey("gyr_w", "", {1e-10, 1}, Noise(&N::gyro_walk)),
      NumberKey("g_norm", "m/s^2", {9, 10.5}, Sensor(&S::gravity_norm)),
  };
}

std::vector<ConfigKey> PointTrackerKeys() {
  return {
      ChoiceKey<CornerDetectorType>(
          "corner_detector",
          {{"shi_tomasi", CornerDetectorType::kShiTomasi}, {"harris", CornerDetectorType::kHarris}},
          Points(&P::corner_detector)),
      FlagKey("corner_subpixel", Points(&P::corner_subpixel)),
      NumberKey("quality_level", "", {1e-6, 0.5}, Points(&P::quality_level)),
      IntegerKey("max_cnt", "corners", {20, 5000}, Points(&P::max_cnt)),
      NumberKey("min_dist", "px", {2, 500}, Points(&P::min_dist)),
      NumberKey("freq", "Hz", {0, 1000}, At(&Config::publish_rate)),
      NumberKey("F_threshold", "px", {0.1, 20}, Points(&P::f_threshold)),
      FlagKey("equalize", Points(&P::equalize)),
      FlagKey("show_track", At(&Config::show_track)),
      ChoiceKey<std::optional<bool>>("fisheye", {{"0", false}, {"1", true}}, Draft(&D::fisheye)),
      TextKey("fisheye_mask", Points(&P::fisheye_mask)),
      IntegerKey("klt_window", "px", {5, 101}, Points(&P::klt_window)),
      IntegerKey("klt_levels", "", {0, 8}, Points(&P::klt_levels)),
      NumberKey("forward_backward", "px", {0.01, 20}, Points(&P::forward_backward)),
  };
}

std::vector<ConfigKey> LineTrackerKeys() {
  return {
      FlagKey("use_lines", At(&Config::use_lines)),
      ChoiceKey<LineDetectorType>("line_detector",
                                  {{"fld", LineDetectorType::kFld},
                                   {"lsd", LineDetectorType::kLsd},
                                   {"edlines", LineDetectorType::kEdLines}},
                                  Lines(&L::line_detector)),
      ChoiceKey<LineMatcherType>("line_matcher",
                                 {{"flow", LineMatcherType::kFlow}, {"lbd", LineMatcherType::kLbd}},
                                 Lines(&L::line_matcher)),
      IntegerKey("max_line_cnt", "lines", {1, 5000}, Lines(&L::max_lines)),
      NumberKey("line_min_length", "", {0.01, 1}, Lines(&L::min_length)),
      NumberKey("line_min_dist", "px", {0, 100}, Lines(&L::spacing)),
      NumberKey("line_min_gradient", "grey levels/px", {0.1, 255}, Lines(&L::min_gradient)),
      NumberKey("line_border", "px", {1, 500}, Lines(&L::border)),
      FlagKey("line_half_resolution", Lines(&L::half_resolution)),
      FlagKey("line_join_fragments", Lines(&L::join_fragments)),
      NumberKey("line_refill_below", "", {0, 1}, Lines(&L::refill_below)),
      IntegerKey("line_refill_interval", "images", {1, 1000}, Lines(&L::refill_interval)),
      NumberKey("line_max_angle", "deg", {0.1, 90}, Lines(&L::max_angle)),
      NumberKey("line_max_distance", "px", {1, 500}, Lines(&L::max_distance)),
      NumberKey("line_min_overlap", "", {0, 1}, Lines(&L::min_overlap)),
      NumberKey("line_min_correlation", "", {0, 1}, Lines(&L::min_correlation)),
      IntegerKey("line_max_descriptor_distance", "bits", {0, 256},
                 Lines(&L::max_descriptor_distance)),
  };
}

std::vector<ConfigKey> EstimatorKeys() {
  return {
      IntegerKey("window_size", "keyframes", {4, 50}, Estimator(&E::window_size)),
      NumberKey("keyframe_parallax", "px", {0.1, 200}, Estimator(&E::keyframe_parallax)),
      IntegerKey("max_num_iterations", "", {1, 100}, Estimator(&E::max_num_iterations)),
      ChoiceKey<SolverType>("solver",
                            {{"schur", SolverType::kSchur}, {"ceres", SolverType::kCeres}},
                            Estimator(&E::solver)),
      NumberKey("point_noise", "px", {0.01, 20}, Estimator(&E::point_noise)),
      NumberKey("line_noise", "px", {0.01, 20}, Estimator(&E::line_noise)),
      NumberKey("line_outlier_distance", "m", {0.1, 1000}, Estimator(&E::line_outlier_distance)),
      FlagKey("line_merging", Estimator(&E::line_merging)),
      NumberKey("line_merge_distance", "m", {0.001, 10}, Estimator(&E::line_merge_distance)),
      NumberKey("line_merge_image_distance", "px", {0.1, 100},
                Estimator(&E::line_merge_image_distance)),
      NumberKey("line_merge_angle", "deg", {0.1, 45}, Estimator(&E::line_merge_angle)),
      IntegerKey("line_anchors", "", {0, 100}, Estimator(&E::line_anchors)),
      FlagKey("manhattan_constraints", Estimator(&E::manhattan_constraints)),
      NumberKey("manhattan_noise", "deg", {0.01, 20}, Estimator(&E::manhattan_noise)),
      FlagKey("zero_velocity_update", Estimator(&E::zero_velocity_update)),
      FlagKey("verbose", Estimator(&E::verbose)),
  };
}

std::vector<ConfigKey> OutputKeys() {
  return {
      TextKey("world_frame", Output(&O::world_frame)),
      TextKey("body_frame", Output(&O::body_frame)),
      TextKey("camera_frame", Output(&O::camera_frame)),
      TextKey("base_frame", Output(&O::base_frame)),
      FlagKey("publish_tf", Output(&O::publish_tf)),
  };
}

}  // namespace

ConfigKey ModelTypeKey() {
  return Required(ChoiceKey<std::optional<Model>>("model_type",
                                                  {{"PINHOLE", Model::kPinhole},
                                                   {"EQUIDISTANT", Model::kEquidistant},
                                                   {"KANNALA_BRANDT", Model::kKannalaBrandt},
                                                   {"MEI", Model::kMei}},
                                                  Draft(&D::model_type)));
}

std::vector<ConfigKey> CameraKeys(Model type) {
  std::vector<ConfigKey> keys = OptionalCameraKeys(type);
  for (ConfigKey& key : keys) key.required = true;
  return keys;
}

std::vector<ConfigKey> GeneralKeys() {
  return Join(Join(SensorKeys(), Join(PointTrackerKeys(), LineTrackerKeys())),
              Join(EstimatorKeys(), OutputKeys()));
}

const std::vector<std::string>& IgnoredKeys() {
  static const std::vector<std::string> keys = {
      "camera_name",  "ex_calib_result_path",  "fast_relocalization",   "load_previous_pose_graph",
      "loop_closure", "max_solver_time",       "min_loop_num",          "output_path",
      "pattern_file", "pose_graph_save_path",  "rolling_shutter_tr",    "save_image",
      "support_path", "visualize_camera_size", "visualize_imu_forward", "voc_file"};
  return keys;
}

}  // namespace plm_vins

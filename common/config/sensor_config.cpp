// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/sensor_config.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "common/config/camera_keys.h"

namespace plm_vins {
namespace {

using S = SensorConfig;
using Key = ConfigKey;

constexpr double kRotationTolerance = 5e-3;     // allows matrices with three decimals
constexpr Range kTranslationRange = {-10, 10};  // [m]
constexpr Range kScaleRange = {0.5, 2};         // scale factors of an IMU's corrections [1]

Problem SetRotation(const Eigen::Matrix3d& R_B_C, Rigid3d* T_B_C) {
  const Eigen::Matrix3d error = R_B_C * R_B_C.transpose() - Eigen::Matrix3d::Identity();
  if (error.cwiseAbs().maxCoeff() > kRotationTolerance || R_B_C.determinant() < 0) {
    return "is not a rotation matrix; its rows must be orthonormal and right-handed";
  }
  T_B_C->rotation = Eigen::Quaterniond(R_B_C).normalized();
  return std::nullopt;
}

Problem SetTranslation(const Eigen::Vector3d& p_B_C, Rigid3d* T_B_C) {
  if (p_B_C.minCoeff() < kTranslationRange.min || p_B_C.maxCoeff() > kTranslationRange.max) {
    return "out of range, each must be " + ToText(kTranslationRange) + " [m]";
  }
  T_B_C->translation = p_B_C;
  return std::nullopt;
}

Key ExtrinsicModeKey(S::ExtrinsicMode* mode) {
  using Mode = S::ExtrinsicMode;
  Key key = Key::Choice<Mode>(
      "estimate_extrinsic",
      {{"0", Mode::kFixed}, {"1", Mode::kRefine}, {"2", Mode::kCalibrateRotation}}, mode);
  key.value = [mode] { return static_cast<int>(*mode); };
  return key;
}

// The value decides which cameras have keys, so it is stored before there are any.
Key CameraCountKey(const std::vector<CameraSensor>* cameras) {
  Key key;
  key.name = "num_of_cam";
  key.unit = "cameras";
  key.allowed = ToText(kCameraCounts);
  key.read = [](const YAML::Node& value) {
    int count = 1;
    return ReadInteger(value, "cameras", kCameraCounts, &count);
  };
  key.value = [cameras] { return ConfigValue(static_cast<int>(cameras->size())); };
  return key;
}

// The transform of camera 0, in the two keys of VINS-Mono.
ConfigKeys FirstTransformKeys(Rigid3d* T_B_C) {
  Key rotation = Key::Matrix(
      "extrinsicRotation", [=] { return T_B_C->R(); },
      [=](const Eigen::MatrixXd& R_B_C) { return SetRotation(R_B_C, T_B_C); });
  rotation.allowed = "orthonormal within " + ToText(kRotationTolerance);
  Key translation = Key::Matrix(
      "extrinsicTranslation", [=] { return T_B_C->translation; },
      [=](const Eigen::MatrixXd& p_B_C) { return SetTranslation(p_B_C, T_B_C); });
  translation.unit = "m";
  translation.allowed = "each " + ToText(kTranslationRange);
  return {rotation, translation};
}

Eigen::MatrixXd Matrix4(const Rigid3d& transform) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(4, 4);
  matrix.topLeftCorner(3, 3) = transform.R();
  matrix.topRightCorner(3, 1) = transform.translation;
  return matrix;
}

ConfigKeys TransformKeys(int camera, Rigid3d* T_B_C) {
  if (camera == 0) return FirstTransformKeys(T_B_C);
  return Required({Key::Matrix(
      TransformKey(camera), [=] { return Matrix4(*T_B_C); },
      [=](const Eigen::MatrixXd& matrix) { return SetTransform(matrix, T_B_C); })});
}

ConfigKeys KeysOfCamera(int number, const std::string& model_type, CameraSensor* camera) {
  ConfigKeys calibration = CameraKeys(model_type, &camera->parameters);
  for (Key& key : calibration) key.name = CameraPrefix(number) + key.name;
  return Join({Required({Key::Text(TopicKey(number), &camera->image_topic)}), calibration,
               TransformKeys(number, &camera->T_B_C)});
}

ConfigKeys DepthKeys(DepthSensor* depth) {
  return {
      Key::Text("depth_topic", &depth->topic),
      Key::Number("depth_noise", "1/m", {1e-6, 1}, &depth->noise),
      Key::Number("depth_unit", "m", {1e-6, 1}, &depth->unit),
      Key::Number("depth_max", "m", {0.1, 1000}, &depth->max),
  };
}

// The scale factors of a matrix are its singular values. The axes of both frames are right-handed,
// so the determinant is positive.
Key CorrectionKey(const std::string& name, Eigen::Matrix3d* correction) {
  const auto set = [correction](const Eigen::Matrix3d& matrix) -> Problem {
    const Eigen::Vector3d scales = matrix.jacobiSvd().singularValues();
    if (scales.minCoeff() < kScaleRange.min || scales.maxCoeff() > kScaleRange.max) {
      return "is not a valid IMU correction; its scale factors must be " + ToText(kScaleRange);
    }
    if (matrix.determinant() < 0) return "mirrors the axes; its determinant must be positive";
    *correction = matrix;
    return std::nullopt;
  };
  Key key = Key::Matrix(
      name, [correction] { return *correction; }, set);
  key.allowed = "scale factors " + ToText(kScaleRange);
  return key;
}

}  // namespace

Problem SetTransform(const Eigen::MatrixXd& T_B_C, Rigid3d* transform) {
  if (T_B_C.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) return "must have 0, 0, 0, 1 as its last row";
  const Problem problem = SetRotation(T_B_C.topLeftCorner(3, 3), transform);
  return problem ? problem : SetTranslation(T_B_C.topRightCorner(3, 1), transform);
}

std::string CameraPrefix(int camera) {
  return camera == 0 ? "" : "cam" + std::to_string(camera) + "_";
}

std::string TopicKey(int camera) {
  return camera == 0 ? "image_topic" : "image" + std::to_string(camera) + "_topic";
}

std::string TransformKey(int camera) { return "body_T_cam" + std::to_string(camera); }

void RemoveDepthWithoutTopic(SensorConfig* sensor) {
  if (sensor->depth && sensor->depth->topic.empty()) sensor->depth.reset();
}

ConfigKeys SensorKeys(const std::vector<std::string>& model_types, SensorConfig* sensor) {
  sensor->cameras.resize(model_types.size());
  if (!sensor->depth) sensor->depth.emplace();
  ConfigKeys cameras = {CameraCountKey(&sensor->cameras)};
  for (size_t i = 0; i < model_types.size(); ++i) {
    const int number = static_cast<int>(i);
    cameras = Join({cameras, KeysOfCamera(number, model_types[i], &sensor->cameras[i])});
  }
  IntrinsicsDeviation* intrinsics = &sensor->intrinsics_deviation;
  ImuNoise* noise = &sensor->imu_noise;
  return Join(
      {cameras,
       {Key::Text("stereo_pairs", &sensor->stereo_pairs)},
       Required({Key::Text("imu_topic", &sensor->imu_topic)}),
       {Key::Flag("estimate_intrinsics", &sensor->estimate_intrinsics),
        Key::Number("focal_length_deviation", "", {1e-6, 0.2}, &intrinsics->focal_length),
        Key::Number("principal_point_deviation", "px", {1e-3, 200}, &intrinsics->principal_point),
        Key::Number("distortion_deviation", "", {1e-6, 1}, &intrinsics->distortion),
        ExtrinsicModeKey(&sensor->estimate_extrinsic)},
       DepthKeys(&*sensor->depth),
       {Key::Number("td", "s", {-1, 1}, &sensor->td),
        Key::Flag("estimate_td", &sensor->estimate_td),
        Key::Number("stamp_tolerance", "s", {0, 0.02}, &sensor->stamp_tolerance),
        Key::Flag("rolling_shutter", &sensor->rolling_shutter),
        Key::Number("rolling_shutter_tr", "s", {0, 0.2}, &sensor->rolling_shutter_tr),
        Key::Choice<S::ImuNoiseModel>(
            "imu_noise_model",
            {{"vins", S::ImuNoiseModel::kVins}, {"continuous", S::ImuNoiseModel::kContinuous}},
            &sensor->imu_noise_model),
        Key::Number("imu_rate", "Hz", {25, 10000}, &sensor->imu_rate),
        Key::Number("accel_bias_deviation", "m/s^2", {1e-3, 5}, &sensor->accel_bias_deviation),
        Key::Number("g_norm", "m/s^2", {9, 10.5}, &sensor->gravity_norm),
        Key::Number("acc_n", "m/s^2/sqrt(Hz); vins: m/s^2", {1e-6, 10}, &noise->accel_density),
        Key::Number("gyr_n", "rad/s/sqrt(Hz); vins: rad/s", {1e-7, 1}, &noise->gyro_density),
        Key::Number("acc_w", "m/s^3/sqrt(Hz); vins: m/s^3", {1e-9, 1}, &noise->accel_walk),
        Key::Number("gyr_w", "rad/s^2/sqrt(Hz); vins: rad/s^2", {1e-10, 1}, &noise->gyro_walk),
        Key::Number("acc_range", "m/s^2", {15, 500}, &sensor->imu.range.accel),
        Key::Number("gyr_range", "rad/s", {0.5, 100}, &sensor->imu.range.gyro),
        CorrectionKey("acc_correction", &sensor->imu.accel_correction),
        CorrectionKey("gyr_correction", &sensor->imu.gyro_correction)}});
}

}  // namespace plm_vins

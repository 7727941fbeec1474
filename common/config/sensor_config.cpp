// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/sensor_config.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "common/config/camera_keys.h"

namespace plm_vins {
namespace {

using S = SensorConfig;
using Key = ConfigKey<S>;

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

Key ExtrinsicModeKey() {
  using Mode = S::ExtrinsicMode;
  Key mode = Key::Choice<Mode>(
      "estimate_extrinsic",
      {{"0", Mode::kFixed}, {"1", Mode::kRefine}, {"2", Mode::kCalibrateRotation}},
      &S::estimate_extrinsic);
  mode.value = [](const S& sensor) { return static_cast<int>(sensor.estimate_extrinsic); };
  return mode;
}

// The value decides which cameras there are, so this key precedes theirs.
Key CameraCountKey() {
  const auto read = [](const YAML::Node& value, S& sensor) {
    int count = 1;
    const Problem problem = ReadInteger(value, "cameras", kCameraCounts, &count);
    sensor.cameras.resize(count);
    return problem;
  };
  const auto value = [](const S& sensor) {
    return ConfigValue(static_cast<int>(sensor.cameras.size()));
  };
  return {"num_of_cam", "cameras", ToText(kCameraCounts), read, value};
}

// The transform of camera 0, in the two keys of VINS-Mono.
ConfigKeys<CameraSensor> FirstTransformKeys() {
  using Key = ConfigKey<CameraSensor>;
  Key rotation = Key::Matrix(
      "extrinsicRotation", [](const CameraSensor& camera) { return camera.T_B_C.R(); },
      [](const auto& R_B_C, CameraSensor& camera) { return SetRotation(R_B_C, &camera.T_B_C); });
  rotation.allowed = "orthonormal within " + ToText(kRotationTolerance);
  Key translation = Key::Matrix(
      "extrinsicTranslation", [](const CameraSensor& camera) { return camera.T_B_C.translation; },
      [](const auto& p_B_C, CameraSensor& camera) { return SetTranslation(p_B_C, &camera.T_B_C); });
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

ConfigKeys<CameraSensor> TransformKeys(int camera) {
  if (camera == 0) return FirstTransformKeys();
  return Required<CameraSensor>({ConfigKey<CameraSensor>::Matrix(
      TransformKey(camera), [](const CameraSensor& sensor) { return Matrix4(sensor.T_B_C); },
      [](const auto& T_B_C, CameraSensor& sensor) { return SetTransform(T_B_C, &sensor.T_B_C); })});
}

ConfigKeys<S> KeysOfCamera(int camera, const std::string& model_type) {
  ConfigKeys<CameraParameters> calibration = CameraKeys(model_type);
  for (auto& key : calibration) key.name = CameraPrefix(camera) + key.name;
  const auto topic = ConfigKey<CameraSensor>::Text(TopicKey(camera), &CameraSensor::image_topic);
  const auto find = [camera](auto& sensor) {
    const bool is_there = camera < static_cast<int>(sensor.cameras.size());
    return is_there ? &sensor.cameras[camera] : nullptr;
  };
  return KeysOfPart<S>(find, Join<CameraSensor>({Required<CameraSensor>({topic}),
                                                 Within(&CameraSensor::parameters, calibration),
                                                 TransformKeys(camera)}));
}

// A topic enables the depth sensor, so its key precedes the others.
ConfigKeys<S> DepthKeys() {
  const auto read = [](const YAML::Node& value, S& sensor) {
    DepthSensor depth;
    const Problem problem = ReadText(value, &depth.topic);
    if (!depth.topic.empty()) sensor.depth = depth;
    return problem;
  };
  const auto value = [](const S& sensor) {
    return ConfigValue(sensor.depth.value_or(DepthSensor()).topic);
  };
  using D = DepthSensor;
  const ConfigKeys<D> others = {
      ConfigKey<D>::Number("depth_noise", "1/m", {1e-6, 1}, &D::noise),
      ConfigKey<D>::Number("depth_max", "m", {0.1, 1000}, &D::max),
  };
  return Join<S>({{{"depth_topic", "", "", read, value}}, Within(&S::depth, others)});
}

ConfigKeys<IntrinsicsDeviation> IntrinsicsDeviationKeys() {
  using Key = ConfigKey<IntrinsicsDeviation>;
  using D = IntrinsicsDeviation;
  return {
      Key::Number("focal_length_deviation", "", {1e-6, 0.2}, &D::focal_length),
      Key::Number("principal_point_deviation", "px", {1e-3, 200}, &D::principal_point),
      Key::Number("distortion_deviation", "", {1e-6, 1}, &D::distortion),
  };
}

ConfigKeys<ImuNoise> ImuNoiseKeys() {
  using Key = ConfigKey<ImuNoise>;
  using N = ImuNoise;
  return {
      Key::Number("acc_n", "m/s^2/sqrt(Hz); vins: m/s^2", {1e-6, 10}, &N::accel_density),
      Key::Number("gyr_n", "rad/s/sqrt(Hz); vins: rad/s", {1e-7, 1}, &N::gyro_density),
      Key::Number("acc_w", "m/s^3/sqrt(Hz); vins: m/s^3", {1e-9, 1}, &N::accel_walk),
      Key::Number("gyr_w", "rad/s^2/sqrt(Hz); vins: rad/s^2", {1e-10, 1}, &N::gyro_walk),
  };
}

// The scale factors of a matrix are its singular values. The axes of both frames are right-handed,
// so the determinant is positive.
ConfigKey<ImuSensor> CorrectionKey(const std::string& name, Eigen::Matrix3d ImuSensor::*field) {
  const auto set = [field](const Eigen::Matrix3d& matrix, ImuSensor& sensor) -> Problem {
    const Eigen::Vector3d scales = matrix.jacobiSvd().singularValues();
    if (scales.minCoeff() < kScaleRange.min || scales.maxCoeff() > kScaleRange.max) {
      return "is not a valid IMU correction; its scale factors must be " + ToText(kScaleRange);
    }
    if (matrix.determinant() < 0) return "mirrors the axes; its determinant must be positive";
    sensor.*field = matrix;
    return std::nullopt;
  };
  auto key = ConfigKey<ImuSensor>::Matrix(
      name, [field](const ImuSensor& sensor) { return sensor.*field; }, set);
  key.allowed = "scale factors " + ToText(kScaleRange);
  return key;
}

ConfigKeys<ImuSensor> ImuSensorKeys() {
  using Key = ConfigKey<ImuSensor>;
  return {
      Key::Number(
          "acc_range", "m/s^2", {15, 500},
          [](auto& sensor) -> auto& { return sensor.range.accel; }),
      Key::Number(
          "gyr_range", "rad/s", {0.5, 100},
          [](auto& sensor) -> auto& { return sensor.range.gyro; }),
      CorrectionKey("acc_correction", &ImuSensor::accel_correction),
      CorrectionKey("gyr_correction", &ImuSensor::gyro_correction),
  };
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

ConfigKeys<SensorConfig> SensorKeys(const std::vector<std::string>& model_types) {
  const ConfigKeys<S> timing = {
      Key::Number("td", "s", {-1, 1}, &S::td),
      Key::Flag("estimate_td", &S::estimate_td),
      Key::Flag("rolling_shutter", &S::rolling_shutter),
      Key::Number("rolling_shutter_tr", "s", {0, 0.2}, &S::rolling_shutter_tr),
  };
  const ConfigKeys<S> noise = {
      Key::Choice<S::ImuNoiseModel>(
          "imu_noise_model",
          {{"vins", S::ImuNoiseModel::kVins}, {"continuous", S::ImuNoiseModel::kContinuous}},
          &S::imu_noise_model),
      Key::Number("imu_rate", "Hz", {25, 10000}, &S::imu_rate),
      Key::Number("accel_bias_deviation", "m/s^2", {1e-3, 5}, &S::accel_bias_deviation),
      Key::Number("g_norm", "m/s^2", {9, 10.5}, &S::gravity_norm),
  };
  ConfigKeys<S> cameras = {CameraCountKey()};
  for (size_t i = 0; i < model_types.size(); ++i) {
    cameras = Join<S>({cameras, KeysOfCamera(static_cast<int>(i), model_types[i])});
  }
  cameras.push_back(Key::Text("stereo_pairs", &S::stereo_pairs));
  return Join<S>({cameras,
                  Required<S>({Key::Text("imu_topic", &S::imu_topic)}),
                  {Key::Flag("estimate_intrinsics", &S::estimate_intrinsics)},
                  Within(&S::intrinsics_deviation, IntrinsicsDeviationKeys()),
                  {ExtrinsicModeKey()},
                  DepthKeys(),
                  timing,
                  noise,
                  Within(&S::imu_noise, ImuNoiseKeys()),
                  Within(&S::imu, ImuSensorKeys())});
}

}  // namespace plm_vins

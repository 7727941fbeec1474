// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/config/config_key.h"
#include "common/geometry/rigid3.h"
#include "common/imu/imu_noise.h"
#include "common/imu/imu_sensor.h"
#include "common/measurements.h"

namespace plm_vins {

// Standard deviations of the configured intrinsics.
struct IntrinsicsDeviation {
  double focal_length = 0.01;  // relative [1]
  double principal_point = 5;  // [px]
  double distortion = 0.005;   // each distortion coefficient [1]
};

// One camera of the rig.
struct CameraSensor {
  std::string image_topic = "/cam0/image_raw";
  CameraParameters parameters;
  Rigid3d T_B_C;  // camera in the body (IMU) frame
};

// Depth images that are registered to camera 0: its size and lens apply.
struct DepthSensor {
  std::string topic;
  double noise = 0.002;  // standard deviation of a depth z is noise * z^2 [1/m]
  double unit = 0.001;   // of an integer in a depth image of type 16UC1 [m]
  double max = 6;        // largest depth that is used [m]
};

// The sensors: topics, calibration, noise.
struct SensorConfig {
  std::vector<CameraSensor> cameras{1};  // by number; 1 to 4
  std::string stereo_pairs = "auto";     // see StereoPairs()
  std::string imu_topic = "/imu0";
  bool estimate_intrinsics = false;
  IntrinsicsDeviation intrinsics_deviation;
  std::optional<DepthSensor> depth;
  enum class ExtrinsicMode { kFixed = 0, kRefine = 1, kCalibrateRotation = 2 };
  ExtrinsicMode estimate_extrinsic = ExtrinsicMode::kFixed;
  double td = 0.0;                 // t_imu = t_image + td [s]
  double stamp_tolerance = 0.002;  // between images of different cameras at one time, and depth [s]
  bool estimate_td = false;
  bool rolling_shutter = false;
  double rolling_shutter_tr = 0.0;  // readout time of the whole image, rows top to bottom [s]
  // Convention of the noise values in a file, and the rate [Hz] that kVins refers to. Always
  // kContinuous after loading.
  enum class ImuNoiseModel { kVins, kContinuous };
  ImuNoiseModel imu_noise_model = ImuNoiseModel::kVins;
  double imu_rate = 200;
  ImuNoise imu_noise;
  double accel_bias_deviation = 0.1;  // standard deviation about 0, per axis [m/s^2]
  ImuSensor imu;
  double gravity_norm = 9.81;  // [m/s^2]

  // Readout time of the whole image [s]; 0 with a global shutter.
  double ReadoutTime() const { return rolling_shutter ? rolling_shutter_tr : 0.0; }
};

constexpr Range kCameraCounts = {1, kMaxCameras};

// Returns the prefix of a camera's calibration keys: "cam2_" as in "cam2_model_type"; empty for
// camera 0.
std::string CameraPrefix(int camera);

// Returns the key of a camera's topic: "image_topic", "image1_topic", ...
std::string TopicKey(int camera);

// Returns the key of the transform of a camera other than 0: "body_T_cam1", ...
std::string TransformKey(int camera);

// Sets the transform from a 4x4 matrix. Returns a problem if it is not a rigid transform.
Problem SetTransform(const Eigen::MatrixXd& T_B_C, Rigid3d* transform);

// Returns all keys, bound to `sensor`, which gets as many cameras as there are types, and a depth
// sensor, since its keys need a field.
ConfigKeys SensorKeys(const std::vector<std::string>& model_types, SensorConfig* sensor);

// Removes a depth sensor that has no topic: the configuration has none.
void RemoveDepthWithoutTopic(SensorConfig* sensor);

}  // namespace plm_vins

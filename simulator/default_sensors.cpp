// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/default_sensors.h"

namespace plm_vins::simulator {

SensorConfig DefaultSensors() {
  SensorConfig sensors;
  CameraParameters& camera = sensors.cameras[0].parameters;
  camera.width = 752;
  camera.height = 480;
  camera.fx = 458.654;
  camera.fy = 457.296;
  camera.cx = 367.215;
  camera.cy = 248.375;
  camera.distortion = {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-5};
  Eigen::Matrix3d R_B_C;
  R_B_C << 0.0148655429818, -0.999880929698, 0.00414029679422,  //
      0.999557249008, 0.0149672133247, 0.025715529948,          //
      -0.0257744366974, 0.00375618835797, 0.999660727178;
  sensors.cameras[0].T_B_C = {Eigen::Quaterniond(R_B_C).normalized(),
                              {-0.0216401454975, -0.064676986768, 0.00981073058949}};
  return sensors;
}

SensorConfig DefaultStereoSensors() {
  SensorConfig sensors = DefaultSensors();
  CameraSensor right = sensors.cameras[0];
  right.image_topic = "/cam1/image_raw";
  right.parameters.fx = 457.587;
  right.parameters.fy = 456.134;
  right.parameters.cx = 379.999;
  right.parameters.cy = 255.238;
  const Rigid3d T_C_C1(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.01, Eigen::Vector3d(0.6, 0.64, 0.48))),
      {0.11, -0.0005, 0.0009});
  right.T_B_C = right.T_B_C * T_C_C1;
  sensors.cameras.push_back(right);
  return sensors;
}

}  // namespace plm_vins::simulator

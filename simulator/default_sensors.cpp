// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/default_sensors.h"

#include <cmath>

#include "common/so3.h"

namespace plm_vins::simulator {

SensorConfig DefaultSensors() {
  SensorConfig sensors;
  CameraParameters& camera = sensors.camera;
  camera.width = 752;
  camera.height = 480;
  camera.fx = 460.0;
  camera.fy = 459.0;
  camera.cx = 370.0;
  camera.cy = 245.0;
  camera.distortion = {-0.28, 0.07, 2e-4, 2e-5};
  const Eigen::Quaterniond quarter_turn = SO3Exp({0, 0, M_PI / 2});
  const Eigen::Quaterniond mounting_error = SO3Exp({0.005, -0.02, 0.01});
  sensors.T_B_C = {quarter_turn * mounting_error, {-0.02, -0.065, 0.01}};
  return sensors;
}

}  // namespace plm_vins::simulator

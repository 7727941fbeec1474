// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/camera/camera_model.h"
#include "common/geometry/rigid3.h"

namespace plm_vins {

// What the estimator may refine of the camera and its place and time beside the IMU.
struct Calibration {
  CameraParameters camera;
  Rigid3d T_B_C;
  double td = 0;       // t_imu = t_image + td [s]
  double readout = 0;  // time of a rolling shutter; 0: a global one [s]
};

}  // namespace plm_vins

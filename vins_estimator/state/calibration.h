// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/camera/camera_model.h"
#include "common/geometry/rigid3.h"

namespace plm_vins {

// Intrinsics and extrinsics of a camera.
struct CameraCalibration {
  CameraParameters parameters;
  Rigid3d T_B_C;
};

// Calibration that the estimator may refine: cameras by number, at least one, and time offset.
struct Calibration {
  std::vector<CameraCalibration> cameras{CameraCalibration()};
  double td = 0;  // t_imu = t_image + td [s]
};

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/camera/camera_model.h"
#include "common/geometry/rigid3.h"

namespace plm_vins {

// Calibration that the estimator may refine: camera intrinsics, extrinsics and time offset.
struct Calibration {
  CameraParameters camera;
  Rigid3d T_B_C;
  // Pose of the second camera in the first, and its intrinsics; set if there is one.
  std::optional<Rigid3d> T_C_C1;
  std::optional<CameraParameters> right_camera;
  double td = 0;  // t_imu = t_image + td [s]
};

}  // namespace plm_vins

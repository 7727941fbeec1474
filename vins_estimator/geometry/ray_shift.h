// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/camera/camera_model.h"

namespace plm_vins {

// Shift of an observed ray by the camera intrinsics c, linearized at the intrinsics with which the
// ray was computed: d_xy_d_intrinsics (c - reference), normalized.
struct RayShift {
  // For a ray (x, y, 1) of `camera`; the shift is zero outside the range of the camera model.
  RayShift(const CameraModel& camera, const Eigen::Vector2d& xy)
      : reference(camera.parameters().intrinsics()),
        d_xy_d_intrinsics(camera.RayByIntrinsics(xy).value_or(IntrinsicsJacobian::Zero())) {}

  Eigen::Vector2d At(const double* intrinsics) const {
    return d_xy_d_intrinsics * (Eigen::Map<const Intrinsics>(intrinsics) - reference);
  }

  Intrinsics reference;
  IntrinsicsJacobian d_xy_d_intrinsics;
};

}  // namespace plm_vins

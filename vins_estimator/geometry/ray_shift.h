// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/camera/camera_model.h"

namespace plm_vins {

// How far an observed ray moves with the intrinsics c of the camera, to first order about those
// that it was computed with: d_xy_d_intrinsics (c - reference), normalised.
struct RayShift {
  // Of rays near (x, y, 1) in `camera`. Zero where that is beyond what the camera can describe.
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

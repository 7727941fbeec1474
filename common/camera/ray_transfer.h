// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/camera/camera_model.h"

namespace plm_vins {

// Moves a ray (x, y, 1), by its normalised image point, from one calibration of a camera to where
// another one sees the same pixel, to a millionth of a pixel, and its velocity in the image with
// it. One that either does not see, at the rim of what a distortion can describe, stays where it
// is.
void TransferRay(const CameraModel& from, const CameraModel& to, Eigen::Vector2d* xy,
                 Eigen::Vector2d* velocity);
void TransferRay(const CameraModel& from, const CameraModel& to, Eigen::Vector2d* xy);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/camera/camera_model.h"

namespace plm_vins {

// Replaces a ray (x, y, 1), given by its normalized image point, of one calibration by the ray of
// the same pixel in another calibration, to a millionth of a pixel, and transforms its image
// velocity. A ray at the limit of the distortion that either calibration cannot project stays
// unchanged.
void TransferRay(const CameraModel& from, const CameraModel& to, Eigen::Vector2d* xy,
                 Eigen::Vector2d* velocity);
void TransferRay(const CameraModel& from, const CameraModel& to, Eigen::Vector2d* xy);

}  // namespace plm_vins

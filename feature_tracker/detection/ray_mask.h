// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "common/camera/camera_model.h"

namespace plm_vins {

// Returns the normalized image point of the pixel, as Unproject() does. Returns nullopt also if it
// exceeds kMaxImageCoordinate, that is for rays perpendicular to the optical axis of a fisheye.
std::optional<Eigen::Vector2d> RayOf(const CameraModel& camera, const Eigen::Vector2d& pixel);

// Removes from `mask` (see ReadMask()) all blocks of a few pixels in which RayOf() returns nullopt
// anywhere. Returns `mask` itself, which may be empty, if the whole image has rays.
cv::Mat WithinRays(const CameraModel& camera, const cv::Mat& mask);

}  // namespace plm_vins

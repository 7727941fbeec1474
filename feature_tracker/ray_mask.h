// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "common/camera/camera_model.h"

namespace plm_vins {

// The normalised image point of the pixel, as Unproject(). Nothing also where it is beyond
// kMaxImageCoordinate, at right angles to the axis of a fisheye.
std::optional<Eigen::Vector2d> RayOf(const CameraModel& camera, const Eigen::Vector2d& pixel);

// `mask` (as of ReadMask()) without the blocks of a few pixels that RayOf() has nothing for, in
// part or all. It is returned as it is, may be empty, where the whole image has rays.
cv::Mat WithinRays(const CameraModel& camera, const cv::Mat& mask);

}  // namespace plm_vins

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "pose_graph/description/descriptor.h"

namespace plm_vins {

// Where "down" points in the image at a pixel whose ray is (xy, 1) [deg, from u towards v]. A
// camera that turns about its axis sees a corner and the direction turn alike.
float GravityAngle(const CameraModel& camera, const Eigen::Quaterniond& R_O_C,
                   const Eigen::Vector2d& xy);

// BRIEF descriptors, rotated so that gravity is the same direction in each: [Rublee2011] with the
// angle from gravity instead of the brightness, which is steadier. Nothing for a corner too near to
// the border. `angles` [deg], one for each corner.
std::vector<std::optional<Descriptor>> DescribeCorners(const cv::Mat& gray,
                                                       const std::vector<Eigen::Vector2f>& uv_px,
                                                       const std::vector<float>& angles);

}  // namespace plm_vins

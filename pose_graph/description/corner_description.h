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

// Returns the image direction of gravity at the pixel with the ray (xy, 1) [deg, from u toward v].
// A rotation about the optical axis rotates it together with the image patch.
float GravityAngle(const CameraModel& camera, const Eigen::Quaterniond& R_O_C,
                   const Eigen::Vector2d& xy);

// Computes BRIEF descriptors with the orientation of [Rublee2011] taken from gravity instead of the
// intensity centroid, which is more repeatable. `angles` [deg] has one element for each corner.
// Returns nullopt for corners too close to the image border.
std::vector<std::optional<Descriptor>> DescribeCorners(const cv::Mat& gray,
                                                       const std::vector<Eigen::Vector2f>& uv_px,
                                                       const std::vector<float>& angles);

}  // namespace plm_vins
